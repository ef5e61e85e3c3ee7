#pragma once

#include <array>
#include <cstddef>

#include "base/image.h"

namespace thermal {

/// 8 bits.
inline constexpr std::size_t kGreyLevels = 256;

/// Use of the grey levels 0 to 255 by a frame.
struct GreyLevels {
  double mean = 0;
  double deviation = 0;
  double low = 0;          ///< 1st percentile
  double high = 0;         ///< 99th
  double empty_share = 0;  ///< share of unused levels from `low` to `high`: a comb
  double roughness =
      0;  ///< mean step between neighbouring levels' counts there over the mean count; 2 of a full comb
  std::array<double, kGreyLevels> shares{};  ///< of the pixels, by level

  [[nodiscard]] double range() const noexcept { return high - low; }
};

/// @param frame  levels 0 to 255; fractions are rounded
[[nodiscard]] GreyLevels grey_levels(const Plane<float>& frame);

}  // namespace thermal
