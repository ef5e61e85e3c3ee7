#pragma once

#include <map>
#include <string>
#include <vector>

#include "heat/surface/heat_of_day.h"

namespace thermal {

/// One material over a day, level and below an open sky; leaves in the middle of their crowns.
struct HeatCurve {
  std::string material;
  SurfaceDay day;
};

/// A moment at which one surface becomes warmer than another.
struct Crossover {
  double solar_h = 0;
  std::string warmer;  ///< from then on
  std::string colder;
};

/// Sensitivity of the materials' temperatures at a moment to one input.
struct InputWorth {
  std::string input;                       ///< in words, such as "wind + 1 m/s"
  std::map<std::string, double> change_k;  ///< by material
};

/// A day's weather and surfaces, for people to read.
struct HeatReport {
  std::vector<HeatCurve> curves;
  std::vector<Crossover> crossovers;  ///< in the order of time
  std::vector<InputWorth> inputs;     ///< at the moment that was asked for
  /// One standard deviation of each material's temperature at that moment that its properties' sources leave [K]. The
  /// spread of each property is an estimate: conductivity 35 %, heat capacity 12 %, albedo 0.04, emissivity 0.02,
  /// roughness a factor 2.5, evaporation 0.1, leaf area 35 %, leaf width a factor 2; the sky 10 W m^-2. For leaves also
  /// a tree's unknown exposure: half of the wind, and half of the excess of the air at their height.
  std::map<std::string, double> uncertainty_k;
};

/// The curves alone: one computation per material. ConfigError as HeatOfDay.
[[nodiscard]] std::vector<HeatCurve> open_curves(const DayWeather& weather,
                                                 const std::map<std::string, MaterialHeat>& materials,
                                                 const HeatSteps& steps = {});

/// The whole report: about fifteen computations per material, on all cores. ConfigError as HeatOfDay.
[[nodiscard]] HeatReport heat_report(const DayWeather& weather,
                                     const std::map<std::string, MaterialHeat>& materials, double solar_h,
                                     const HeatSteps& steps = {});

}  // namespace thermal
