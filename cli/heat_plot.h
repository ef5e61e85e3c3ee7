#pragma once

#include <string>
#include <vector>

#include "heat/surface/heat_report.h"

namespace veldt {

/// One day of a plot, with flight hours.
struct PlottedDay {
  std::string title;
  const thermal::DayWeather* weather = nullptr;
  const thermal::HeatReport* report = nullptr;
  std::vector<std::pair<double, double>>
      flown_h;  ///< from, to; from 0 to 24, or beyond for flights over midnight
};

/// An SVG with a chart a day, one below the other: curves of all surfaces and of the air in kelvin over local solar
/// time, dots where open soil crosses another surface, and flight hours shaded.
[[nodiscard]] std::string heat_svg(const std::vector<PlottedDay>& days);

}  // namespace veldt
