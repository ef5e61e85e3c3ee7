#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "heat/surface/heat_of_day.h"
#include "imaging/ground_window.h"
#include "scene/ground_maps.h"

namespace thermal {

/// Temperatures of the covers of the ground at one moment, cell by cell of a window of ground maps: each cell by its sky
/// view, its sunlit hours, its moisture and its slope. Read in straight lines between the middles of cells; detail
/// smaller than a pixel's footprint is averaged out.
class GroundTemperatures {
 public:
  /// One cover of the ground: its temperatures by place, and how they vary besides, from the correlation length down to
  /// two cells.
  struct Cover {
    const MaterialMoment* heat = nullptr;
    double stddev_k = 0;
    double correlation_length_m = 1;
  };

  /// `sunlit` is the share of the day's sunbeams of each cell of the maps; empty: all of them. Computed on all cores.
  GroundTemperatures(const GroundMaps& maps, const GroundWindow& window, std::span<const float> sunlit,
                     double open_moisture, std::span<const Cover> covers, std::uint32_t seed);

  /// Where to read: a row of places [m], the size of a pixel there [m], and the cover of each pixel by its surface; no
  /// cover is -1.
  struct Places {
    std::span<const std::uint16_t> surface;
    std::span<const std::int32_t> cover_of_surface;
    std::span<const float> x_m;
    std::span<const float> y_m;
    std::span<const float> footprint_m;
  };

  /// Temperatures [K] of the pixels with a cover; those of others stay as they are, as do those of pixels with a place or
  /// footprint that is not finite or a negative footprint. Places beyond the window have the temperature at its border.
  /// Steps of 1/512 K.
  void sample(const Places& places, std::span<float> temperature_k) const noexcept;

  /// Share of the sky that level ground sees at these places, of the maps, for pixels with a cover. Otherwise as sample().
  void sample_sky_view(const Places& places, std::span<float> sky_view) const;

  /// Height of the highest plant above a place, and of the ground where there is none [m]: in the world's coordinates.
  [[nodiscard]] float crown_top_m(float x_m, float y_m) const noexcept;

 private:
  struct Level {
    std::int32_t first = 0;  ///< of its texels
    std::int32_t width = 0;
    std::int32_t height = 0;
    float per_m = 0;  ///< cells of this level in a metre
  };

  void sample_layers(const Places& places, float base, std::span<float> values) const noexcept;
  void add_level(const std::vector<std::vector<float>>& covers_k, std::size_t width, std::size_t height,
                 double per_m);

  float origin_x_m_ = 0;  ///< of the south-west corner of the window
  float origin_y_m_ = 0;
  float base_k_ = 0;
  std::vector<Level> levels_;
  std::int32_t covers_ = 0;
  /// Level by level, cover by cover, then the sky view: a texel and its right neighbour.
  std::vector<std::int32_t> texels_;
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::vector<float> crown_top_m_;  ///< of the window's cells
};

}  // namespace thermal
