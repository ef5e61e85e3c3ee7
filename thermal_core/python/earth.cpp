#include <array>
#include <cmath>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.h"
#include "dataset/exports/geodesy.h"
#include "python/arrays.h"
#include "python/parts.h"

namespace thermal::python {
namespace {

/// Latitude, longitude [deg] and height [m].
using Position = std::array<double, 3>;

/// ConfigError for latitudes beyond `most_deg`.
GeoPosition geo_position_of(const Position& position, double most_deg) {
  const auto [latitude_deg, longitude_deg, height_m] = position;
  // Also for NaN.
  if (!(std::abs(latitude_deg) <= most_deg))
    throw ConfigError(
        fault("latitude", fmt::format("{}", latitude_deg), "deg", fmt::format("-{0} to {0}", most_deg)));
  if (!(std::abs(longitude_deg) <= 360))
    throw ConfigError(fault("longitude", fmt::format("{}", longitude_deg), "deg", "-360 to 360"));
  if (!std::isfinite(height_m))
    throw ConfigError(fault("height", fmt::format("{}", height_m), "m", "a number"));
  return {.latitude_deg = latitude_deg, .longitude_deg = longitude_deg, .height_m = height_m};
}

}  // namespace

void add_earth(py::module_& module) {
  py::class_<Georeference>(module, "Georeference")
      .def(py::init([](const Position& origin) { return Georeference(geo_position_of(origin, 89)); }),
           py::arg("origin"))
      .def(
          "point_at",
          [](const Georeference& georeference, const Position& position) {
            return georeference.point_at(geo_position_of(position, 90));
          },
          py::arg("position"));
}

}  // namespace thermal::python
