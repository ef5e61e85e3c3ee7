#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "heat/surface/material_heat.h"
#include "heat/surface/orientation_fit.h"
#include "heat/surface/surface_day.h"

namespace thermal {

/// What a place does to a surface there.
struct SurfacePlace {
  EastNorthUp normal = {0, 0, 1};
  double sky_view = 1;  ///< share of the sky that its slope leaves and nothing hides, 0 to 1
  double sunlit = 1;    ///< share of the day's sunbeams that reach it, 0 to 1
  double moisture = 0;  ///< 0 dry to 1 saturated
};

/// Moisture of open ground some days after rain: 0.7 exp(-days / 6), an estimate.
[[nodiscard]] double moisture_after_rain(double days) noexcept;

/// Nodes of a table, between which temperatures are interpolated: in sky view and sunlit by the polynomial through all
/// nodes, in moisture by straight lines. A surface that does not depend on an axis has a single node there.
struct HeatNodes {
  std::vector<double> sky_view;  ///< rising
  std::vector<double> sunlit;
  std::vector<double> moisture;

  [[nodiscard]] std::size_t count() const noexcept {
    return sky_view.size() * sunlit.size() * moisture.size();
  }
};

/// Temperatures of one material at one moment, by place: those of level surfaces, and what slopes add in full sun.
class MaterialMoment {
 public:
  /// `level_k` by sky view, in it by sunlit, in it by moisture; `slopes_k` by node of moisture.
  MaterialMoment(HeatNodes nodes, std::vector<double> level_k, std::vector<Orientation> slopes_k);

  /// Values outside of the nodes count as the nearest node's.
  [[nodiscard]] double temperature_k(const SurfacePlace& place) const noexcept;

  /// The same as a function of the normal.
  [[nodiscard]] Orientation orientation(const SurfacePlace& place) const noexcept;

 private:
  [[nodiscard]] double level_k(const SurfacePlace& place) const noexcept;

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

/// The temperatures of materials over a day that repeats itself: all columns of heat that a scene needs, computed once.
class HeatOfDay {
 public:
  /// ConfigError if the weather is invalid, or a material's leaves grow on one that is not ground. The columns are
  /// computed on all cores.
  HeatOfDay(const DayWeather& weather, const std::map<std::string, MaterialHeat>& materials,
            const HeatSteps& steps = {});

  /// At a local solar time, any finite number of hours.
  [[nodiscard]] HeatOfMoment at(double solar_h) const;

  /// How fast a material warms at a moment where it is level and open [K/h].
  [[nodiscard]] double rate_k_h(const std::string& material, double solar_h) const;

  [[nodiscard]] const DayWeather& weather() const noexcept { return weather_; }
  /// How many columns of heat were computed.
  [[nodiscard]] std::size_t columns() const noexcept;

 private:
  /// The days of one material.
  struct Columns {
    HeatNodes nodes;
    OrientationFit fit;
    std::vector<SurfaceDay> level;   ///< node by node
    std::vector<SurfaceDay> slopes;  ///< moisture by moisture, in it direction by direction but for up
  };

  [[nodiscard]] static MaterialMoment moment_of(const Columns& columns, double solar_h,
                                                const EastNorthUp& sun);

  DayWeather weather_;
  SurfaceDay ground_;
  std::map<std::string, Columns> columns_;
};

/// The day of one piece of a material. `soil` is the ground below leaves, `open_ground_k` what slopes face.
[[nodiscard]] SurfaceDay day_of(const MaterialHeat& heat, const GroundHeat& soil, const SurfacePlace& place,
                                const DayAround& around, const HeatSteps& steps);

}  // namespace thermal
