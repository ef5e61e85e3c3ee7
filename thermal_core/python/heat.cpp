#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "heat/surface/heat_of_day.h"
#include "heat/weather/forcing.h"
#include "imaging/typical_heat.h"
#include "io/config/materials.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

constexpr std::size_t kPlacesPerChunk = 256;

Season season_of(const std::string& name) {
  for (const Season season : {Season::winter, Season::summer})
    if (season_name(season) == name) return season;
  throw ConfigError(fault("season", '"' + name + '"', "", "winter or summer"));
}

/// A day's weather, and the temperatures of all materials in it.
class Day {
 public:
  Day(const std::string& season, const std::string& sections, const std::string& home)
      : Day(season_of(season), *settings_of_sections(sections, "weather", Assets(home)), Assets(home)) {}

  [[nodiscard]] const std::vector<std::string>& materials() const { return names_; }

  [[nodiscard]] py::array_t<double> air_k(const py::object& given) const {
    const ArrayOf<double> solar_h = finite_numbers_of(given, "solar_h");
    py::array_t<double> result = array_like<double>(solar_h);
    std::transform(solar_h.data(), solar_h.data() + solar_h.size(), result.mutable_data(),
                   [this](double hour) { return air_temperature_k(heat_.weather(), hour); });
    return result;
  }

  /// `normals`: (…, 3) for exposures of shape (…).
  [[nodiscard]] py::array_t<double> temperatures_k(const std::string& material, double solar_h,
                                                   const py::object& sky_views, const py::object& sunlits,
                                                   const py::object& moistures,
                                                   const py::object& normal_vectors) const {
    check_material(material);
    const ArrayOf<double> sky_view = finite_numbers_of(sky_views, "sky_view");
    const ArrayOf<double> sunlit = finite_numbers_of(sunlits, "sunlit");
    const ArrayOf<double> moisture = finite_numbers_of(moistures, "moisture");
    const ArrayOf<double> normals = finite_numbers_of(normal_vectors, "normal");
    if (sunlit.size() != sky_view.size() || moisture.size() != sky_view.size() ||
        normals.size() != 3 * sky_view.size())
      throw ConfigError(fault("normal", fmt::format("{} numbers", normals.size()), "",
                              fmt::format("3 for each of {} places", sky_view.size())));
    py::array_t<double> result = array_like<double>(sky_view);
    double* const out = result.mutable_data();
    const auto count = static_cast<std::size_t>(sky_view.size());
    const py::gil_scoped_release others_run;
    const HeatOfMoment moment = heat_.at(solar_h, {material});
    const MaterialMoment& heat = moment.materials.at(material);
    parallel_for(count, kPlacesPerChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const double* const normal = normals.data() + 3 * i;
        out[i] = heat.temperature_k({.normal = {normal[0], normal[1], normal[2]},
                                     .sky_view = sky_view.data()[i],
                                     .sunlit = sunlit.data()[i],
                                     .moisture = moisture.data()[i]});
      }
    });
    return result;
  }

  [[nodiscard]] double open_moisture() const { return moisture_after_rain(heat_.weather().rain_days_ago); }

 private:
  Day(Season season, const ClipSettings& settings, const Assets& assets)
      : heat_(settings.weather[static_cast<std::size_t>(season)].day,
              heat_of_materials(read_materials(assets))) {
    for (const auto& [name, heat] : heat_of_materials(read_materials(assets))) names_.push_back(name);
  }

  void check_material(const std::string& material) const {
    if (std::ranges::find(names_, material) != names_.end()) return;
    throw ConfigError(fault("material", '"' + material + '"', "", "one of " + list_names(names_)) +
                      did_you_mean(material, names_));
  }

  HeatOfDay heat_;
  std::vector<std::string> names_;
};

}  // namespace

void add_heat(py::module_& module) {
  py::class_<Day>(module, "Day")
      .def(py::init<const std::string&, const std::string&, const std::string&>(), py::arg("season"),
           py::arg("sections"), py::arg("home"))
      .def_property_readonly("materials", &Day::materials)
      .def_property_readonly("open_moisture", &Day::open_moisture)
      .def("air_k", &Day::air_k, py::arg("solar_h"))
      .def("temperatures_k", &Day::temperatures_k, py::arg("material"), py::arg("solar_h"),
           py::arg("sky_view"), py::arg("sunlit"), py::arg("moisture"), py::arg("normals"));
}

}  // namespace thermal::python
