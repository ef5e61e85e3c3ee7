#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace thermal {

/// Ground warmer than its surroundings: an ellipse, and an excess by distance from its centre.
struct WarmSpot {
  double x_m = 0;  ///< of its centre
  double y_m = 0;
  double heading_rad = 0;  ///< of its length, counter-clockwise from east
  double half_length_m = 1;
  double half_width_m = 1;
  double reach = 1;  ///< extent, in half axes of the ellipse, above 0
  /// At even steps from the centre to `reach`, at least two; interpolated linearly, 0 beyond.
  std::vector<float> excess_k;

  [[nodiscard]] bool operator==(const WarmSpot&) const = default;
};

/// The warm spots of a clip, sampled at pixel centres: spots smaller than a pixel are not averaged.
class WarmSpots {
 public:
  explicit WarmSpots(std::vector<WarmSpot> spots) : spots_(std::move(spots)) {}

  [[nodiscard]] bool empty() const noexcept { return spots_.empty(); }

  /// Excess at a point [K], the largest of overlapping spots, 0 outside of all.
  [[nodiscard]] float excess_k(float x_m, float y_m) const noexcept;

  /// Adds the excess to the temperatures of a row's ground pixels; `is_ground` is 1 for surfaces that are ground.
  /// Positions that are not finite get none. Costs nothing without spots.
  void add(std::span<const std::uint16_t> surface, std::span<const std::int32_t> is_ground,
           std::span<const float> x_m, std::span<const float> y_m,
           std::span<float> temperature_k) const noexcept;

 private:
  std::vector<WarmSpot> spots_;
};

}  // namespace thermal
