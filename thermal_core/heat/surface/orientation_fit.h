#pragma once

#include <array>
#include <span>
#include <vector>

#include "heat/weather/sun.h"

namespace thermal {

/// A function of the direction that a surface faces: quadratic in its normal. Sunlight on a matt surface is nearly such a
/// function (Ramamoorthi and Hanrahan, JOSA A 18, 2448, 2001), and the sky's and the ground's radiation is one.
struct Orientation {
  static constexpr std::size_t kTerms = 9;  ///< 1, x, y, z, x^2, y^2, x y, x z, y z
  std::array<double, kTerms> coefficients{};

  [[nodiscard]] static std::array<double, kTerms> terms_of(const EastNorthUp& normal) noexcept;
  [[nodiscard]] double at(const EastNorthUp& normal) const noexcept;
};

/// Directions at which surfaces are computed: up, and eight aspects at each of some slopes.
class OrientationFit {
 public:
  /// For ground, which faces up more or less: slopes of 20 and 40 deg.
  [[nodiscard]] static OrientationFit of_ground();
  /// For bodies, which face all directions: slopes of 45, 90 and 135 deg.
  [[nodiscard]] static OrientationFit of_bodies();
  /// For surfaces that are level: one direction.
  [[nodiscard]] static OrientationFit of_level();

  [[nodiscard]] const std::vector<EastNorthUp>& directions() const noexcept { return directions_; }

  /// The function nearest to the values at the directions, by least squares; for ground, up counts as much as all others.
  [[nodiscard]] Orientation fit(std::span<const double> values) const;

 private:
  OrientationFit(std::vector<double> slopes_deg, std::vector<std::size_t> terms);

  std::vector<EastNorthUp> directions_;
  std::vector<std::size_t> terms_;        ///< that are fitted; the others are 0
  std::vector<double> weights_;           ///< of the directions
  std::vector<std::vector<double>> fit_;  ///< [term][direction]
};

}  // namespace thermal
