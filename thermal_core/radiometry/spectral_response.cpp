#include "radiometry/spectral_response.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

void check(std::span<const SpectralResponse::Sample> samples) {
  if (samples.size() < 2) {
    throw ConfigError(fault("response: samples", fmt::format("{}", samples.size()), "", "at least 2"));
  }
  double before_um = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto [wavelength_um, response] = samples[i];
    if (!(wavelength_um > before_um) || !std::isfinite(wavelength_um)) {
      throw ConfigError(fault(fmt::format("response: wavelength {}", i + 1), fmt::format("{}", wavelength_um),
                              "um", fmt::format("a finite number above {} um", before_um)));
    }
    if (!(response >= 0) || !std::isfinite(response)) {
      throw ConfigError(fault(fmt::format("response at {} um", wavelength_um), fmt::format("{}", response),
                              "", "a finite number of at least 0"));
    }
    before_um = wavelength_um;
  }
}

}  // namespace

SpectralResponse SpectralResponse::flat(double begin_um, double end_um) {
  return SpectralResponse({{begin_um, 1.0}, {end_um, 1.0}});
}

SpectralResponse::SpectralResponse(std::vector<Sample> samples) : samples_(std::move(samples)) {
  check(samples_);
  const auto less = [](const Sample& a, const Sample& b) { return a.response < b.response; };
  const double peak = std::max_element(samples_.begin(), samples_.end(), less)->response;
  if (peak == 0) throw ConfigError(fault("response: largest value", "0", "", "more than 0"));
  for (Sample& sample : samples_) sample.response /= peak;
}

double SpectralResponse::at(double wavelength_um) const noexcept {
  if (!(wavelength_um >= begin_um() && wavelength_um <= end_um())) return 0;
  const auto next =
      std::lower_bound(samples_.begin(), samples_.end(), wavelength_um,
                       [](const Sample& sample, double value_um) { return sample.wavelength_um < value_um; });
  if (next->wavelength_um == wavelength_um) return next->response;
  const Sample& last = *(next - 1);
  const double share = (wavelength_um - last.wavelength_um) / (next->wavelength_um - last.wavelength_um);
  return last.response + share * (next->response - last.response);
}

}  // namespace thermal
