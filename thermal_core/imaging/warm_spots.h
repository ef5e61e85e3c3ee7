#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace thermal {

/// Ground that is warmer than what surrounds it: an ellipse, and an excess that depends on how far out a place is.
struct WarmSpot {
  double x_m = 0;  ///< of its middle
  double y_m = 0;
  double heading_rad = 0;  ///< of its length, counter-clockwise from east
  double half_length_m = 1;
  double half_width_m = 1;
  double reach = 1;  ///< where it ends, in half axes of the ellipse, above 0
  /// At even steps from the middle to `reach`, at least two; straight lines between them, nothing beyond.
  std::vector<float> excess_k;

  [[nodiscard]] bool operator==(const WarmSpot&) const = default;
};

/// The warm spots of a clip. A pixel has the excess of its middle: spots smaller than a pixel are not averaged.
class WarmSpots {
 public:
  explicit WarmSpots(std::vector<WarmSpot> spots) : spots_(std::move(spots)) {}

  [[nodiscard]] bool empty() const noexcept { return spots_.empty(); }

  /// Excess at a place [K], 0 outside of all spots: the largest where several overlap.
  [[nodiscard]] float excess_k(float x_m, float y_m) const noexcept;

  /// Adds the excess to the temperatures of a row's pixels that show ground: those whose surface is ground: 1, others 0.
  /// Places that are not finite get none. Costs nothing without spots.
  void add(std::span<const std::uint16_t> surface, std::span<const std::int32_t> is_ground,
           std::span<const float> x_m, std::span<const float> y_m,
           std::span<float> temperature_k) const noexcept;

 private:
  std::vector<WarmSpot> spots_;
};

}  // namespace thermal
