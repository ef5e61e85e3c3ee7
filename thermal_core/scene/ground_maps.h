#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "heat/weather/sun.h"
#include "scene/baked_scene.h"

namespace thermal {

/// In which hours of a day the sun reaches the ground.
struct SunlitHours {
  SunPath path;
  /// Per cell: bit k is set if the sun's beam reaches it in the middle of hour k of local solar time.
  std::vector<std::uint32_t> hours;

  [[nodiscard]] bool operator==(const SunlitHours&) const = default;
};

/// What the ground is made of, on cells x cells squares of about half a metre, [row of y, column of x], from south and
/// west. Shares are bytes, of which 255 is all.
struct GroundCovers {
  std::size_t cells = 0;
  std::vector<std::string> kinds;     ///< materials; the first is bare soil
  std::vector<std::uint8_t> kind;     ///< index in `kinds`; bare soil where grass grows
  std::vector<std::uint8_t> grass;    ///< on bare soil alone; so are the others
  std::vector<std::uint8_t> trodden;  ///< packed by feet or wheels
  std::vector<std::uint8_t> ash;
  /// Distance from the middle of a cell to the border of its kind; 255 is one and a half cells or more.
  std::vector<std::uint8_t> border;

  [[nodiscard]] bool operator==(const GroundCovers&) const = default;
};

/// What each square of the ground receives, [row of y, column of x], from south and west, of cells x cells squares. The
/// area is that of BakedGround: a square of size_m around the origin. Values are those of the middle of a cell, on the
/// drawn ground or water. Actors are not part of it. Where no clip of a plan sees the ground, sky and sun are those of
/// an open plain: sky_view is 255, and all hours of the day are sunlit.
struct GroundMaps {
  double size_m = 0;
  std::size_t cells = 0;
  /// Share of the sky that a level surface sees through crowns and past relief, each part weighted by the cosine of its
  /// angle from the vertical; 255 is all of an open sky.
  std::vector<std::uint8_t> sky_view;
  std::vector<float> height_m;         ///< of the ground, or of the water above it
  std::vector<float> crown_top_m;      ///< the highest plant above that; 0: none
  std::vector<std::uint8_t> moisture;  ///< 255: saturated; see ground_moisture()
  std::vector<float> water_m = {};     ///< depth of the water, 0 on land; empty: no water
  GroundCovers covers = {};
  std::vector<SunlitHours> sunlit;  ///< one for each sun path

  [[nodiscard]] bool operator==(const GroundMaps&) const = default;
};

/// Cells along a side: of at most 1 m, or coarser in scenes of more than 4096 m.
/// @param size_m  greater than 0; at least one cell
[[nodiscard]] std::size_t ground_map_cells(double size_m) noexcept;

/// Coordinate of the middle of a cell's row or column [m].
[[nodiscard]] inline double cell_middle_m(double size_m, std::size_t cells, std::size_t number) noexcept {
  return size_m * ((static_cast<double>(number) + 0.5) / static_cast<double>(cells) - 0.5);
}

/// The highest surfaces above the middles of cells x cells squares, [row of y, column of x], from south and west; minus
/// infinity where there is none.
struct TopHeights {
  std::vector<float> ground_m;  ///< of ground and waters
  std::vector<float> plants_m;
};

/// Of the square of size_m around the origin, by projecting every triangle: exact to single precision, without gaps
/// between triangles that share an edge. The same bits for any number of threads.
[[nodiscard]] TopHeights top_heights(const BakedScene& scene, double size_m, std::size_t cells);

/// How moist the ground is in the middles of cells x cells squares, [row of y, column of x], from south and west; 255
/// is saturated. The larger of two terms, both estimates: 1 in water and at its shore, falling by a factor of e every 4
/// m outwards; and up to 0.5 in hollows, in proportion to the rise of the land on two opposite sides, 30 m away, up to
/// 2 m. The foot of a slope is no hollow. `ground` has at least one cell.
[[nodiscard]] std::vector<std::uint8_t> ground_moisture(const BakedGround& ground, std::size_t cells);

/// Depth of the water in the middles of the same squares [m], 0 on land: height of the highest surface, ground or
/// water, above the ground. Empty without water.
[[nodiscard]] std::vector<float> water_depths_m(const BakedGround& ground, std::span<const float> highest_m,
                                                std::size_t cells);

}  // namespace thermal
