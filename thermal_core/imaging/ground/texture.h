#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "imaging/row_kernels.h"
#include "scene/variation_field.h"

namespace thermal {

/// Moves points on the ground by a decimetre, by a fixed random field, so that borders in maps of half a metre become
/// uneven down to the pixel: fractal, of dimension 1.26, as the maps at their own scale. Temperatures are those of the
/// maps. The field repeats after 16 m, the warped ground does not.
class GroundWarp {
 public:
  explicit GroundWarp(std::uint32_t seed);

  /// Standard deviation of the displacement along each axis (estimate).
  static constexpr float kMoveM = 0.12F;

  /// Warps positions [m], with sizes of pixels there [m]; detail smaller than a pixel is averaged out. Positions that
  /// are not finite or beyond 100 km are unchanged. All spans have one length.
  void move(std::span<const float> x_m, std::span<const float> y_m, std::span<const float> footprint_m,
            std::span<float> moved_x_m, std::span<float> moved_y_m) const noexcept;

 private:
  VariationField east_;
  VariationField north_;
};

/// Values of the cells of a rectangle of the ground, [row of y, column of x], from south and west.
struct GroundGrid {
  std::size_t width = 0;
  std::size_t height = 0;
  double cells_per_m = 1;
  double origin_x_m = 0;  ///< of its south-west corner
  double origin_y_m = 0;
};

/// Values of each cell of the texture.
struct GroundValues {
  std::vector<float> temperature_k;
  std::vector<float> per_h_k;   ///< change per hour
  std::vector<float> sky_view;  ///< share of the sky that level ground sees, 0 to 1
};

/// Temperature and sky view of the ground as a mipmapped texture of four bytes a texel.
class GroundTexture {
 public:
  GroundTexture(const GroundGrid& grid, GroundValues values);

  /// A row of positions on the ground [m], the size of a pixel there [m], and which surfaces are ground: 1, others 0.
  struct Points {
    std::span<const std::uint16_t> surface;
    std::span<const std::int32_t> is_ground;
    std::span<const float> x_m;
    std::span<const float> y_m;
    std::span<const float> footprint_m;
    kernels::FootprintRange footprints;  ///< contains all of footprint_m that are finite and not negative
  };

  /// Temperatures [K] of the pixels of ground, `later_h` after the moment of the grids, and the share of the sky that
  /// level ground sees there: interpolated linearly between the middles of cells, with detail smaller than a pixel
  /// averaged out. Other pixels keep their temperature and get -1 as their sky view, as do those with a position or
  /// footprint that is not finite or a negative footprint. Beyond the grid, its border is replicated. Steps of 1/512 K,
  /// of 1/255, and of 1/127 of the fastest warming.
  void sample(const Points& points, float later_h, std::span<float> temperature_k,
              std::span<float> sky_view) const noexcept;

 private:
  struct Level {
    std::int32_t first = 0;  ///< of its texels
    std::int32_t width = 0;
    std::int32_t height = 0;
    float per_m = 0;  ///< cells of this level in a metre
  };

  void add_level(const GroundValues& values, std::size_t width, std::size_t height, double per_m);

  float origin_x_m_ = 0;
  float origin_y_m_ = 0;
  float base_k_ = 0;
  float warming_step_k_h_ = 0;
  std::vector<Level> levels_;
  std::vector<std::int32_t> texels_;  ///< level by level
};

}  // namespace thermal
