#pragma once

namespace thermal {

/// Plausible range of a physical quantity in what a drone's camera sees. A number outside has another unit, or stands
/// for "no value": readers refuse it, or count it as unusable.
struct PlausibleRange {
  double least;
  double most;

  /// False for NaN.
  [[nodiscard]] constexpr bool holds(double value) const noexcept { return value >= least && value <= most; }
};

/// Temperature of a pixel or of a surface [K]: from below the coldest clear sky to above a wood fire.
inline constexpr PlausibleRange kTemperatureK = {100, 2000};
/// Median temperature of a picture [K]: from the ground of a polar night to sand at noon.
inline constexpr PlausibleRange kSceneMedianK = {220, 350};
/// Distance of a surface from the camera [m]: past the horizon of the highest flight.
inline constexpr PlausibleRange kDistanceM = {1e-3, 1e5};

}  // namespace thermal
