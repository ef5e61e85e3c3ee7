#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/rng.h"
#include "sensor/sensor_parameters.h"
#include "sensor/streams.h"

namespace thermal {

/// State of the shutter at a frame.
struct ShutterState {
  std::uint32_t event = 0;  ///< closings since a moment before the clip; frames of one event share a pattern
  double since_intervals =
      0;                ///< time since the closing as a fraction of the interval, 0 to 1; 0 without a shutter
  bool closed = false;  ///< the picture is frozen

  /// Growth of patterns since a closing, 1 at the next one: sqrt(t) / 2 + t / 2, with t the elapsed fraction of the
  /// interval: a power law plus a linear part, as measured on uncooled cameras (SPIE 12533); the weights are an
  /// estimate.
  [[nodiscard]] double growth() const noexcept {
    return 0.5 * std::sqrt(since_intervals) + 0.5 * since_intervals;
  }
};

/// The camera's timer: the shutter closes every interval. A clip starts at a random phase, a function of (seed,
/// clip), so that its first frame is statistically like any other.
class Shutter {
 public:
  Shutter(const ShutterParameters& parameters, std::uint32_t seed, std::string_view clip);

  /// A frame is frozen if the shutter closed at its time or less than freeze_s before.
  [[nodiscard]] ShutterState at(double time_s) const noexcept;

  /// The first frame of an event at a frame rate, 0 if the event began before the clip. Requires an interval, if the
  /// event is not 0.
  [[nodiscard]] std::uint32_t first_frame(std::uint32_t event, double rate_hz) const noexcept;

  /// Time from the last closing to the start of the clip [s].
  [[nodiscard]] double begins_s() const noexcept { return begins_s_; }

 private:
  ShutterParameters parameters_;
  double begins_s_;
};

/// Error of all apparent temperatures of a clip, 2 to 5 K for uncooled cameras: a constant of the clip, plus a drift
/// since the last closing of the shutter. Both are normal. Data sheets are taken to state two standard deviations; that
/// the drift grows to a quarter of the clip's error is an estimate.
class RadiometricError {
 public:
  RadiometricError(double accuracy_k, std::uint32_t seed, std::string_view clip)
      : drift_k_(kDrift * 0.5 * accuracy_k),
        field_{.seed = seed, .stream = kAccuracyDriftStream, .clip = hash_name(clip), .frame = 0} {
    if (accuracy_k > 0) clip_k_ = 0.5 * accuracy_k * normal(kAccuracyStream, 0);
  }

  /// Error in a state of the shutter, to be added to every temperature [K].
  [[nodiscard]] double at_k(const ShutterState& shutter) const noexcept {
    if (drift_k_ == 0 || shutter.since_intervals == 0) return clip_k_;
    return clip_k_ + drift_k_ * normal(kAccuracyDriftStream, shutter.event) * shutter.growth();
  }

 private:
  static constexpr double kDrift = 0.25;

  [[nodiscard]] double normal(std::uint32_t stream, std::uint32_t frame) const noexcept {
    RandomField field = field_;
    field.stream = stream;
    field.frame = frame;
    float value = 0;
    fill_normal(field, 0, std::span(&value, 1));
    return static_cast<double>(value);
  }

  double clip_k_ = 0;
  double drift_k_;
  RandomField field_;
};

}  // namespace thermal
