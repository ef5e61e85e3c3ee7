#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "heat/surface/heat_of_day.h"
#include "imaging/ground_texture.h"
#include "imaging/ground_window.h"
#include "scene/ground_maps.h"

namespace thermal {

/// How the temperature of a cover varies besides what its place makes, from the correlation length down to two cells.
struct CoverVariation {
  double stddev_k = 0;
  double correlation_length_m = 1;
};

/// What warms the covers of the ground at one moment.
struct GroundMoment {
  std::vector<const MaterialMoment*> covers;
  std::span<const float>
      sunlit;  ///< share of the day's sunbeams of each cell of the maps; empty: all of them
};

/// The same at the first and the last moment of some time.
struct GroundWarmth {
  GroundMoment first;
  GroundMoment last;
  double hours = 0;  ///< between them; 0: `last` is not read
  double open_moisture = 0;
  bool by_slope = true;  ///< otherwise all cells are level
};

/// Temperatures of the covers of the ground over some time, cell by cell of a window of ground maps: each cell by its
/// sky view, its sunlit hours, its moisture and its slope.
class GroundTemperatures {
 public:
  /// `variations` of each cover. Computed on all cores.
  GroundTemperatures(const GroundMaps& maps, const GroundWindow& window,
                     std::span<const CoverVariation> variations, const GroundWarmth& heat,
                     std::uint32_t seed);

  /// In time, temperatures follow a straight line; its moment is half-way.
  [[nodiscard]] const GroundTexture& texture() const noexcept { return texture_; }

  /// Height of the highest plant above a place, and of the ground where there is none [m]: in the world's coordinates.
  [[nodiscard]] float crown_top_m(float x_m, float y_m) const noexcept;

 private:
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  double per_m_ = 1;
  double origin_x_m_ = 0;  ///< of the south-west corner of the window
  double origin_y_m_ = 0;
  std::vector<float> crown_top_m_;  ///< of the window's cells
  GroundTexture texture_;
};

}  // namespace thermal
