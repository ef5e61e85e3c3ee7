#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "base/error.h"
#include "dataset/exports/geodesy.h"
#include "python/arrays.h"
#include "python/parts.h"
#include "sensor/thermal_camera.h"

namespace thermal::python {
namespace {

/// A number from `least` to `most`; ConfigError for others.
double within(double least, double most, double value, const char* what, const char* unit) {
  if (value >= least && value <= most) return value;
  throw ConfigError(fault(what, fmt::format("{}", value), unit, fmt::format("{} to {}", least, most)));
}

/// A camera, with memory for one frame. Calls from several threads are serialised.
class Camera {
 public:
  Camera(const std::string& sections, const std::string& home, const std::string& clip, std::uint32_t seed,
         double frame_rate_hz, double air_k, double brightest_w_m2_sr)
      : settings_(settings_of_sections(sections, "camera", Assets(home))),
        camera_(
            settings_->sensor,
            {.id = clip,
             .seed = seed,
             .frame_rate_hz = within(0.1, 240, frame_rate_hz, "frame_rate_hz", "Hz"),
             .width_px = settings_->camera.width_px,
             .height_px = settings_->camera.height_px,
             .noise_gain = {},
             .air_k = within(150, 350, air_k, "air_k", "K")},
            static_cast<float>(within(1e-6, 1e6, brightest_w_m2_sr, "brightest_w_m2_sr", "W m^-2 sr^-1"))),
        radiance_w_m2_sr_(settings_->camera.width_px, settings_->camera.height_px) {}

  [[nodiscard]] py::tuple expose(const py::object& given) {
    const ArrayOf<float> radiance_w_m2_sr(plane_in(given, "radiance_w_m2_sr"));
    check_shape(radiance_w_m2_sr);
    SensorFrame frame;
    {
      const py::gil_scoped_release others_run;
      const std::lock_guard turn(mutex_);
      std::copy_n(radiance_w_m2_sr.data(), radiance_w_m2_sr_.size(), radiance_w_m2_sr_.pixels().begin());
      camera_.expose(radiance_w_m2_sr_, frame);
    }
    return py::make_tuple(array_of(std::move(frame.ir8)), array_of(std::move(frame.ir16)),
                          frame.shutter_closed);
  }

  void skip() {
    const std::lock_guard turn(mutex_);
    camera_.skip();
  }

  [[nodiscard]] double temperature_k(double radiance_w_m2_sr) const {
    return camera_.temperature_k(radiance_w_m2_sr);
  }
  [[nodiscard]] const ClipSettings& settings() const { return *settings_; }

 private:
  void check_shape(const ArrayOf<float>& radiance_w_m2_sr) const {
    const CameraIntrinsics& camera = settings_->camera;
    if (radiance_w_m2_sr.shape(0) == camera.height_px && radiance_w_m2_sr.shape(1) == camera.width_px) return;
    throw ConfigError(fault(
        "radiance_w_m2_sr", fmt::format("{} x {}", radiance_w_m2_sr.shape(1), radiance_w_m2_sr.shape(0)),
        "px", fmt::format("{} x {}, as the camera has", camera.width_px, camera.height_px)));
  }

  SharedSettings settings_;
  ThermalCamera camera_;
  Plane<float> radiance_w_m2_sr_;
  std::mutex mutex_;
};

}  // namespace

void add_camera(py::module_& module) {
  py::class_<Camera>(module, "Camera")
      .def(py::init<const std::string&, const std::string&, const std::string&, std::uint32_t, double, double,
                    double>(),
           py::arg("sections"), py::arg("home"), py::arg("clip"), py::arg("seed"), py::arg("frame_rate_hz"),
           py::arg("air_k"), py::arg("brightest_w_m2_sr"))
      .def("expose", &Camera::expose, py::arg("radiance_w_m2_sr"))
      .def("skip", &Camera::skip)
      .def("temperature_k", &Camera::temperature_k, py::arg("radiance_w_m2_sr"))
      .def_property_readonly("width_px", [](const Camera& of) { return of.settings().camera.width_px; })
      .def_property_readonly("height_px", [](const Camera& of) { return of.settings().camera.height_px; })
      .def_property_readonly("kelvin_per_count",
                             [](const Camera& of) { return of.settings().sensor.kelvin_per_count; })
      .def_property_readonly("netd_k", [](const Camera& of) { return of.settings().netd_k; })
      .def_property_readonly("response", [](const Camera& of) {
        py::list samples;
        for (const SpectralResponse::Sample& one : of.settings().sensor.response.samples())
          samples.append(py::make_tuple(one.wavelength_um, one.response));
        return samples;
      });
}

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
