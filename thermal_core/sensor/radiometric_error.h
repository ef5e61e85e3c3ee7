#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/rng.h"
#include "sensor/shutter.h"
#include "sensor/streams.h"

namespace thermal {

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
