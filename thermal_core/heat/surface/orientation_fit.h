#pragma once

#include <array>
#include <span>
#include <vector>

#include "heat/weather/sun.h"

namespace thermal {

/// A function of the direction that a surface faces: quadratic in its normal, and linear in the cosine to the sun where
/// that is above the surface. The quadratic part follows the sky, the ground and the sunlight of the hours before, which
/// is nearly quadratic (Ramamoorthi and Hanrahan, JOSA A 18, 2448, 2001); the other the sunlight of now.
struct Orientation {
  static constexpr std::size_t kTerms =
      10;  ///< 1, x, y, z, x^2, y^2, x y, x z, y z, max(0, cosine to the sun)
  std::array<double, kTerms> coefficients{};
  EastNorthUp sun = {0, 0, 0};  ///< 0: it is not up

  [[nodiscard]] static std::array<double, kTerms> terms_of(const EastNorthUp& normal,
                                                           const EastNorthUp& sun) noexcept;
  [[nodiscard]] double at(const EastNorthUp& normal) const noexcept;
};

/// Directions at which surfaces are computed: up, and eight aspects at each of some slopes.
class OrientationFit {
 public:
  /// For ground, which faces up more or less: slopes of 20 and 40 deg.
  [[nodiscard]] static OrientationFit of_ground();
  /// For bodies, which face all directions: slopes of 45, 90 and 135 deg, and down.
  [[nodiscard]] static OrientationFit of_bodies();
  /// For surfaces that are level: one direction.
  [[nodiscard]] static OrientationFit of_level();

  [[nodiscard]] const std::vector<EastNorthUp>& directions() const noexcept { return directions_; }

  /// The function nearest to the values at the directions, by least squares; for ground, up, which a drone sees most
  /// of, weighs as much as all others together and is then exact.
  /// @param sun  its direction, or 0 if it is not up
  [[nodiscard]] Orientation fit(std::span<const double> values, const EastNorthUp& sun) const;

 private:
  OrientationFit(std::vector<double> slopes_deg, std::vector<std::size_t> terms);

  std::vector<EastNorthUp> directions_;
  std::vector<std::size_t> terms_;  ///< of the quadratic part, that are fitted; the others are 0
  std::vector<double> weights_;     ///< of the directions
};

/// Direction to the sun shortly before a moment, because surfaces respond late; 0 if it was below the horizon.
[[nodiscard]] EastNorthUp sun_of_surfaces(const SunPath& path, double solar_h) noexcept;

}  // namespace thermal
