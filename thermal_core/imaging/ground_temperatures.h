#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "heat/surface/heat_of_day.h"
#include "imaging/cut_covers.h"
#include "imaging/ground_mixture.h"
#include "imaging/ground_shift.h"
#include "imaging/ground_texture.h"
#include "imaging/ground_window.h"
#include "scene/ground_maps.h"

namespace thermal {

/// What one part of the ground has at a moment. All of it is drawn as bare soil, see SoilLook.
struct GroundPart {
  const MaterialMoment* heat = nullptr;
  GroundShift shift = {};
  double variation_k = 0;  ///< standard deviation of what is uneven within it
};

/// What warms the parts of the ground at one moment.
struct GroundMoment {
  std::vector<GroundPart> parts;  ///< in the order of ground_part_names()
  std::span<const float> sunlit;  ///< share of the day's sunbeams of each cell of the maps; empty: all
  double cold_pool_k =
      0;  ///< by which the lowest cell of the maps is colder than the highest, all others by height
};

/// The same at the first and the last moment of some time.
struct GroundWarmth {
  GroundMoment first;
  GroundMoment last;
  double hours = 0;  ///< between them; 0: `last` is not read
  double open_moisture = 0;
  bool by_slope = true;  ///< otherwise all cells are level
};

/// What the ground of a clip is made of.
struct GroundOfWindow {
  GroundWindow maps;             ///< cells of the maps
  CutWindow covers;              ///< the covers in them
  std::vector<GroundMix> mixes;  ///< of the cells of the cut covers
  std::vector<float> damp;       ///< of the cells of the maps: what is added to their moisture
  std::vector<float>
      fabric;  ///< of the cells of the cut covers, standard normal: what is uneven within a part
};

/// @param rough  see ground_mixture(); also whether the soil's moisture varies, by 2 % over 15 m, and each part's
/// temperature by half of its variation over 2 m and less (estimates); otherwise damp and fabric are empty
[[nodiscard]] GroundOfWindow ground_of_window(const GroundMaps& maps, const GroundWindow& window, bool rough,
                                              std::uint32_t seed);

/// Temperatures of the ground over some time: each part by the sky view, the sunlit hours, the moisture and the slope of
/// its cell of the maps, interpolated, mixed by the shares of its cell of the cut covers, and smoothed over the neighbours.
/// Temperatures are mixed, not radiances: parts 10 K apart look colder by up to 0.14 K. Computed on all cores.
/// @return in time, temperatures follow a straight line; its moment is half-way
[[nodiscard]] GroundTexture ground_temperatures(const GroundMaps& maps, const GroundOfWindow& ground,
                                                const GroundWarmth& heat);

/// Depths of the waters of a window, in straight lines between the middles of the maps' cells.
class WaterDepths {
 public:
  WaterDepths(const GroundMaps& maps, const GroundWindow& window);

  /// [m]; 0 where no cell around has water.
  [[nodiscard]] float at(float x_m, float y_m) const noexcept;

 private:
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  double per_m_ = 1;
  double origin_x_m_ = 0;  ///< of the south-west corner of the window
  double origin_y_m_ = 0;
  std::vector<float> depth_m_;  ///< of the window's cells; empty: no water
};

/// Heights of the highest plant above places, and of the ground where there is none.
class CrownTops {
 public:
  CrownTops(const GroundMaps& maps, const GroundWindow& window);

  /// [m], in the world's coordinates.
  [[nodiscard]] float at(float x_m, float y_m) const noexcept;

 private:
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  double per_m_ = 1;
  double origin_x_m_ = 0;  ///< of the south-west corner of the window
  double origin_y_m_ = 0;
  std::vector<float> top_m_;  ///< of the window's cells
};

}  // namespace thermal
