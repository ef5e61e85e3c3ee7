#pragma once

#include <cstdint>

namespace thermal {

/// Purposes of the sensor's random numbers: one stream each. Never reuse a number.
enum SensorStream : std::uint32_t {
  kWhiteStream = 1,
  kFirstFramePatternStream = 2,
  kFixedPatternStream = 3,
  kFixedRowStream = 4,
  kFixedColumnStream = 5,
  kDriftStream = 6,
  kTemporalRowStream = 7,
  kTemporalColumnStream = 8,
  kFrameStream = 9,
  kShutterPhaseStream = 10,
  kBandingPhaseStream = 11,
  kDeadPixelStream = 12,
  kBlinkingPixelStream = 13,
  kBlinkStream = 14,
  // Do not reuse 15, an earlier 1/f noise.
  kFlickerStartStream = 16,  ///< and the 31 numbers after it, one for each process
  kFlickerPhaseStream = 48,
  kGainPixelStream = 49,
  kGainWaveStream = 50,
  kHaloStream = 51,
  kLateDeadStream = 52,
  kLateDeadMomentStream = 53,
  kAccuracyStream = 54,
  kAccuracyDriftStream = 55,
  kLinkNoiseStream = 56,
  kLinkRowStream = 57,
  kLinkDriftStream = 58,
  kLinkJitterStream = 59,
  kLinkHumStream = 60,
  kLinkDropoutStream = 61,
  kLinkStreakStream = 62,
  kChainNoiseStream = 63,
  kFlickerStream = 64,  ///< and the 31 numbers after it, one for each process
};

}  // namespace thermal
