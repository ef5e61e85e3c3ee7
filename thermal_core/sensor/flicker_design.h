#pragma once

#include <cstdint>
#include <vector>

namespace thermal {

/// A first-order autoregressive process, updated at ticks and constant in between. With a random phase of its ticks it
/// is stationary: its autocorrelation is keep^m at m periods, linear from one period to the next.
struct FlickerProcess {
  std::uint32_t period_frames = 1;  ///< native frames from tick to tick, a power of two
  double keep = 0;                  ///< correlation from tick to tick
  double variance = 0;
};

/// White noise plus 1/f noise as a sum: one normal number in each frame, and a few slow processes. The processes have
/// corners a factor of 4 or less apart, from 1e-3 Hz to 0.8 of the knee, or to a third of Nyquist if that is lower, and
/// tick 1.25 to 2.5 times in their time constant. The 1/f noise above them is small beside the white noise and is added
/// to its variance.
///
/// Why ticks and no filter in every frame: a slow video of a fast sensor then needs as few normal numbers a second as
/// any other (6 a pixel at a knee of 0.5 Hz), and a frame is the same whichever frames are requested. Why constant
/// between ticks and not linear: the variance is then the same in every frame. A step is a tenth of the white noise.
struct FlickerDesign {
  std::vector<FlickerProcess> processes;  ///< the fastest first, every period a multiple of those before it
  double white_variance = 0;              ///< of the rest, in each frame

  /// Scaled to (2 / rate) (1 Hz / f), which at 1 Hz equals the spectrum of white noise of variance 1. Minimises the
  /// squared relative error of (1 + knee / f), evenly in log frequency from 3e-3 Hz to Nyquist. That sum is within 0.5
  /// dB there, at rates of 9 Hz and knees of 0.01 Hz and more. Requires rate_hz > 0, knee_hz > 0.
  [[nodiscard]] static FlickerDesign fit(double rate_hz, double knee_hz);

  /// Power spectral density at a frequency, one-sided [1/Hz], `white_variance` included; exact for uniformly
  /// distributed phases. Frequency in (0, rate / 2].
  [[nodiscard]] double density(double frequency_hz, double rate_hz) const;

  /// Variance in every frame, `white_variance` included.
  [[nodiscard]] double variance() const noexcept;
};

}  // namespace thermal
