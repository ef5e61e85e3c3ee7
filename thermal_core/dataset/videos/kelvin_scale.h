#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sensor/agc.h"

namespace thermal {

/// A range of apparent temperatures of a video.
struct KelvinRange {
  double low_k = 0;
  double high_k = 0;
};

/// "270:300". ConfigError "--range = …" unless 0 <= LO < HI <= 10000.
[[nodiscard]] KelvinRange parse_kelvin_range(std::string_view text);

/// Apparent temperatures of each of 256 levels.
struct KelvinScale {
  /// Level k covers edges_k[k] to edges_k[k + 1], non-decreasing; the first edge may be minus infinity, the last ones
  /// infinity.
  std::array<double, kLevels + 1> edges_k{};

  /// Position of a temperature on a bar of 256 bands of equal height, from 0 at the coldest end to 1; linear between
  /// the edges of a level. Empty below the first finite edge and above the last.
  [[nodiscard]] std::optional<double> position_of(double temperature_k) const;

  /// Range of place_of(); two equal ends if it is empty.
  [[nodiscard]] KelvinRange known() const;
};

/// The scale of a frame's tone curve: thresholds in counts of ir16, of kelvin_per_count each. Everything measured reaches
/// a threshold of 1, nothing reaches 65535.
[[nodiscard]] KelvinScale scale_of_curve(const std::array<std::uint16_t, kLevels - 1>& thresholds,
                                         double kelvin_per_count);

/// Bands of equal width from low_k to high_k.
[[nodiscard]] KelvinScale linear_scale(const KelvinRange& range);

/// The level of each count of ir16.
[[nodiscard]] std::vector<std::uint8_t> levels_of_counts(const KelvinScale& scale, double kelvin_per_count);

/// A mark on the bar.
struct ScaleTick {
  double temperature_k = 0;
  double position = 0;  ///< as place_of()
  std::string label;    ///< "285", "285.5"
};

/// Round temperatures, hottest last, that are at least `least_gap` of the bar apart: as many as fit, in steps of 1, 2 or
/// 5 times a power of ten, 1000 K to 0.01 K. Steps are finer where the scale is stretched.
[[nodiscard]] std::vector<ScaleTick> ticks_of(const KelvinScale& scale, double least_gap);

}  // namespace thermal
