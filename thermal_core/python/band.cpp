#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "io/config/spectra.h"
#include "python/arrays.h"
#include "python/parts.h"
#include "radiometry/band_radiance.h"
#include "radiometry/radiance_table.h"
#include "radiometry/spectral_response.h"

namespace thermal::python {
namespace {

constexpr std::size_t kValuesPerChunk = 256;

/// Applies `function` to every value, on all cores.
template <typename Function>
py::array_t<double> mapped(const py::object& given, const char* what, const Function& function) {
  const ArrayOf<double> values = numbers_of<double>(given, what);
  py::array_t<double> results = array_like<double>(values);
  const double* const in = values.data();
  double* const out = results.mutable_data();
  const auto count = static_cast<std::size_t>(values.size());
  const py::gil_scoped_release others_run;
  parallel_for(count, kValuesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) out[i] = function(in[i]);
  });
  return results;
}

/// A response, the integrals over it, and the table used for frames, which is built at its first use.
class Band {
 public:
  explicit Band(SpectralResponse response) : response_(std::move(response)), reference_(response_) {}

  [[nodiscard]] const SpectralResponse& response() const { return response_; }
  [[nodiscard]] const BandRadiance& reference() const { return reference_; }

  [[nodiscard]] py::array_t<float> table_radiances(const py::object& given) {
    const ArrayOf<float> temperatures_k = numbers_of<float>(given, "temperature_k");
    py::array_t<float> results = array_like<float>(temperatures_k);
    const auto count = static_cast<std::size_t>(temperatures_k.size());
    const float* const in = temperatures_k.data();
    float* const out = results.mutable_data();
    const py::gil_scoped_release others_run;
    std::call_once(tabulated_, [this] { table_.emplace(reference_); });
    parallel_for(count, kValuesPerChunk, [&](std::size_t begin, std::size_t end) {
      table_->radiances({in + begin, end - begin}, {out + begin, end - begin});
    });
    return results;
  }

 private:
  SpectralResponse response_;
  BandRadiance reference_;
  std::once_flag tabulated_;
  std::optional<RadianceTable> table_;
};

std::unique_ptr<Band> band_of_samples(const py::object& given) {
  const ArrayOf<double> samples = finite_numbers_of(given, "response");
  if (samples.ndim() != 2 || samples.shape(1) != 2)
    throw ConfigError(fault("response", fmt::format("{} numbers", samples.size()), "",
                            "rows of a wavelength [um] and a relative response, (n, 2)"));
  std::vector<SpectralResponse::Sample> of_response;
  for (py::ssize_t k = 0; k < samples.shape(0); ++k)
    of_response.push_back({.wavelength_um = samples.at(k, 0), .response = samples.at(k, 1)});
  return std::make_unique<Band>(SpectralResponse(std::move(of_response)));
}

}  // namespace

void add_band(py::module_& module) {
  py::class_<Band>(module, "Band")
      .def(py::init(&band_of_samples), py::arg("samples"))
      .def_static(
          "of_file", [](const std::string& file) { return std::make_unique<Band>(read_response(file)); },
          py::arg("file"))
      .def_property_readonly("begin_um", [](const Band& band) { return band.response().begin_um(); })
      .def_property_readonly("end_um", [](const Band& band) { return band.response().end_um(); })
      .def("table_radiances", &Band::table_radiances, py::arg("temperatures_k"))
      .def(
          "radiances",
          [](const Band& band, const py::object& temperatures_k) {
            return mapped(temperatures_k, "temperature_k",
                          [&](double k) { return band.reference().radiance(k); });
          },
          py::arg("temperatures_k"))
      .def(
          "derivatives",
          [](const Band& band, const py::object& temperatures_k) {
            return mapped(temperatures_k, "temperature_k",
                          [&](double k) { return band.reference().evaluate(k).derivative_w_m2_sr_k; });
          },
          py::arg("temperatures_k"))
      .def(
          "relative_error_bounds",
          [](const Band& band, const py::object& temperatures_k) {
            return mapped(temperatures_k, "temperature_k",
                          [&](double k) { return band.reference().relative_error_bound(k); });
          },
          py::arg("temperatures_k"))
      .def(
          "temperatures",
          [](const Band& band, const py::object& radiances_w_m2_sr) {
            return mapped(radiances_w_m2_sr, "radiance_w_m2_sr",
                          [&](double l) { return band.reference().temperature(l); });
          },
          py::arg("radiances_w_m2_sr"));
}

}  // namespace thermal::python
