#pragma once

#include <array>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "heat/surface/material_heat.h"
#include "heat/surface/orientation_fit.h"
#include "heat/surface/surface_day.h"

namespace thermal {

/// Exposure of a surface to sky, sun and water.
struct SurfaceExposure {
  EastNorthUp normal = {0, 0, 1};
  double sky_view = 1;  ///< share of the sky that its slope leaves and nothing hides, 0 to 1
  double sunlit = 1;    ///< share of the day's sunbeams that reach it, 0 to 1
  double moisture = 0;  ///< 0 dry to 1 saturated
  double depth_m = 1;   ///< of water, 0 or more
};

/// Moisture of open ground some days after rain: 0.7 exp(-days / 6), an estimate.
[[nodiscard]] double moisture_after_rain(double days) noexcept;

/// Nodes of a table, between which temperatures are interpolated: in sky view and sunlit by the polynomial through all
/// nodes, in moisture by straight lines. A surface that does not depend on an axis has a single node there.
struct HeatNodes {
  std::vector<double> sky_view;  ///< rising
  std::vector<double> sunlit;
  std::vector<double> moisture;  ///< of water, its depth [m]
  bool is_water = false;

  [[nodiscard]] double moisture_at(const SurfaceExposure& exposure) const noexcept {
    return is_water ? exposure.depth_m : exposure.moisture;
  }
  [[nodiscard]] std::size_t count() const noexcept {
    return sky_view.size() * sunlit.size() * moisture.size();
  }
};

/// Temperatures of one material at one moment, by exposure: those of level surfaces, and what slopes add in full sun.
class MaterialMoment {
 public:
  /// `level_k` by sky view, then sunlit, then moisture; `slopes_k` by moisture.
  MaterialMoment(HeatNodes nodes, std::vector<double> level_k, std::vector<Orientation> slopes_k);

  /// Values outside of the nodes count as the nearest node's.
  [[nodiscard]] double temperature_k(const SurfaceExposure& exposure) const noexcept;

  /// The same as a function of the normal.
  [[nodiscard]] Orientation orientation(const SurfaceExposure& exposure) const noexcept;

 private:
  [[nodiscard]] double level_k(const SurfaceExposure& exposure) const noexcept;

  HeatNodes nodes_;
  std::vector<double> level_k_;
  std::vector<Orientation> slopes_k_;
};

/// The temperatures of materials at one moment.
struct HeatOfMoment {
  Forcing forcing;
  double ground_k = 0;          ///< of open level ground, which standing bodies face
  double ground_moisture = 0;   ///< of it, after the last rain
  EastNorthUp sun = {0, 0, 0};  ///< see sun_of_surfaces()
  std::map<std::string, MaterialMoment> materials;
};

/// For tables, whose interpolation is a fifth of a kelvin off: half of the usual steps, settled to a hundredth.
inline constexpr HeatSteps kTableSteps = {.per_day = 144, .settled_k = 0.01};

/// The temperatures of materials over a day that repeats itself. The columns of heat of a material are computed when it is
/// first asked for, on all cores, and kept. Safe to use from several threads.
class HeatOfDay {
 public:
  /// ConfigError if the weather is invalid, or a material's leaves grow on one that is not ground.
  HeatOfDay(const DayWeather& weather, std::map<std::string, MaterialHeat> materials,
            const HeatSteps& steps = kTableSteps);

  /// Of those `materials` that have heat, at a local solar time, any finite number of hours.
  [[nodiscard]] HeatOfMoment at(double solar_h, const std::set<std::string>& materials = {}) const;

  [[nodiscard]] const DayWeather& weather() const noexcept { return weather_; }
  /// How many columns of heat were computed so far.
  [[nodiscard]] std::size_t columns() const;

 private:
  /// The days of one material.
  struct Columns {
    HeatNodes nodes;
    OrientationFit fit;
    std::vector<SurfaceDay> level;   ///< node by node
    std::vector<SurfaceDay> slopes;  ///< moisture by moisture, in it direction by direction but for up
  };

  /// Computes what is missing.
  void compute(const std::set<std::string>& materials) const;
  /// The columns of a material at one of its nodes of moisture.
  void compute(const std::string& material, std::size_t moisture, Columns& columns) const;
  [[nodiscard]] static MaterialMoment moment_of(const Columns& columns, double solar_h,
                                                const EastNorthUp& sun);

  DayWeather weather_;
  std::map<std::string, MaterialHeat> materials_;
  HeatSteps steps_;
  std::vector<Forcing> forcing_;
  SurfaceDay ground_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Columns> columns_;
};

/// The day of one piece of a material. `soil` is the ground below leaves, `open_ground_k` what slopes face. `like`: a day
/// of a similar piece, from which it is found in fewer days; see day_of_ground().
[[nodiscard]] SurfaceDay day_of(const MaterialHeat& heat, const GroundHeat& soil,
                                const SurfaceExposure& exposure, const DayAround& around,
                                const HeatSteps& steps, const SurfaceDay* like = nullptr);

}  // namespace thermal
