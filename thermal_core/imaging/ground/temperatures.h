#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "heat/surface/heat_of_day.h"
#include "imaging/ground/mixture.h"
#include "imaging/ground/noise.h"
#include "imaging/ground/texture.h"
#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"
#include "scene/ground_maps.h"

namespace thermal {

/// Temperature offset, linear in the sky view, by which a part of the ground is drawn as bare soil with the same
/// apparent temperature.
struct GroundShift {
  double without_sky_k = 0;
  double by_sky_view_k = 0;
};

/// All kinds of ground are drawn as one surface, with the emissivity of bare soil. Higher emissivity looks warmer under
/// a clear sky: grass (0.96) beside soil (0.91) by about 1.5 K.
class SoilAppearance {
 public:
  /// @param reflects  whether surfaces reflect the sky and its obstacles
  SoilAppearance(BandRadiance soil, const BandAir& air, double air_k, bool reflects);

  /// Offset of a part at a temperature [K]: exact at that temperature without sky and with all of it, seen from above.
  /// At a point 10 K warmer or colder, the error is up to 11 K times the difference of the emissivities: 0.5 K for
  /// grass.
  [[nodiscard]] GroundShift shift(const BandRadiance& part, double temperature_k) const;

 private:
  [[nodiscard]] double apparent_k(const BandRadiance& part, double temperature_k, double sky_view) const;

  BandRadiance soil_;
  double air_k_;
  double sky_emissivity_;
  bool reflects_;
};

/// State of one part of the ground at a moment. All parts are drawn as bare soil, see SoilAppearance.
struct GroundPart {
  const MaterialMoment* heat = nullptr;
  GroundShift shift = {};
  double variation_k = 0;  ///< standard deviation of the variation within it
};

/// Inputs of the ground's temperatures at one moment.
struct GroundMoment {
  std::vector<GroundPart> parts;  ///< in the order of ground_part_names()
  std::span<const float> sunlit;  ///< share of the day's sunbeams of each cell of the maps; empty: all
  double cold_pool_k =
      0;  ///< how much colder the lowest cell of the maps is than the highest, linear in height between
};

/// The same at the first and the last moment of a span.
struct GroundWarmth {
  GroundMoment first;
  GroundMoment last;
  double hours = 0;  ///< between them; 0: `last` is not read
  double open_moisture = 0;
  bool by_slope = true;  ///< otherwise all cells are level
};

/// Composition of the ground of a clip.
struct GroundOfWindow {
  GroundWindow maps;             ///< cells of the maps
  CutWindow covers;              ///< the covers in them
  std::vector<GroundMix> mixes;  ///< of the cells of the cut covers
  std::vector<float> damp;       ///< by cell of the maps: added to its moisture
  std::vector<float> fabric;     ///< by cell of the cut covers, standard normal: variation within a part
};

/// @param rough  see ground_mixture(); if set, the soil's moisture varies, by 2 % over 15 m, and each part's
/// temperature by half of its variation over 2 m and less (estimates); otherwise `damp` and `fabric` are empty
[[nodiscard]] GroundOfWindow ground_of_window(const GroundMaps& maps, const GroundWindow& window, bool rough,
                                              std::uint32_t seed);

/// Temperatures of the ground over a span: each part by the sky view, the sunlit hours, the moisture and the slope of
/// its cell of the maps, interpolated, mixed by the shares of its cell of the cut covers, and smoothed over the
/// neighbours. Temperatures are mixed, not radiances: parts 10 K apart look colder by up to 0.14 K. Computed on all
/// cores.
/// @return a texture for the middle of the span, linear in time
[[nodiscard]] GroundTexture ground_temperatures(const GroundMaps& maps, const GroundOfWindow& ground,
                                                const GroundWarmth& heat);

/// Depths of the waters of a window, interpolated linearly between the middles of the maps' cells.
class WaterDepths {
 public:
  WaterDepths(const GroundMaps& maps, const GroundWindow& window);

  /// Depth [m]; 0 where no cell around has water.
  [[nodiscard]] float at(float x_m, float y_m) const noexcept;

 private:
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  double per_m_ = 1;
  double origin_x_m_ = 0;  ///< of the south-west corner of the window
  double origin_y_m_ = 0;
  std::vector<float> depth_m_;  ///< of the window's cells; empty: no water
};

/// Height of the highest plant above points, or of the ground where there is none.
class CrownTops {
 public:
  CrownTops(const GroundMaps& maps, const GroundWindow& window);

  /// Height [m] in the world's coordinates.
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
