#include "radiometry/emissivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

void check_emissivity(const std::string& where, double value) {
  if (value >= 0 && value <= 1) return;
  throw ConfigError(fault(where, fmt::format("{}", value), "", "from 0 to 1"));
}

/// Share of unpolarised light a smooth surface lets through, at a cosine of incidence in air.
double fresnel_transmitted(std::complex<double> index, double cosine) {
  const std::complex<double> inside = std::sqrt(index * index - (1 - cosine * cosine));
  const auto reflected_s = std::norm((cosine - inside) / (cosine + inside));
  const auto reflected_p = std::norm((index * index * cosine - inside) / (index * index * cosine + inside));
  return 1 - (reflected_s + reflected_p) / 2;
}

/// The same for water, averaged over 8, 9 … 14 um. Complex indices: Hale and Querry, Appl. Opt. 12, 555 (1973).
double water_transmitted(double cosine) {
  constexpr std::array<std::complex<double>, 7> kIndices = {{{1.291, 0.0343},
                                                             {1.262, 0.0399},
                                                             {1.218, 0.0508},
                                                             {1.153, 0.0968},
                                                             {1.111, 0.199},
                                                             {1.123, 0.305},
                                                             {1.171, 0.370}}};
  double sum = 0;
  for (const std::complex<double>& index : kIndices) sum += fresnel_transmitted(index, cosine);
  return sum / static_cast<double>(kIndices.size());
}

}  // namespace

EmissivitySpectrum::EmissivitySpectrum(double emissivity) : samples_{{1, emissivity}} {
  check_emissivity("emissivity", emissivity);
}

EmissivitySpectrum::EmissivitySpectrum(std::vector<Sample> samples) : samples_(std::move(samples)) {
  if (samples_.size() < 2) {
    throw ConfigError(
        fault("emissivity spectrum: samples", fmt::format("{}", samples_.size()), "", "at least 2"));
  }
  double before_um = 0;
  for (const auto& [wavelength_um, emissivity] : samples_) {
    if (!(wavelength_um > before_um) || !std::isfinite(wavelength_um)) {
      throw ConfigError(fault("emissivity spectrum: wavelength", fmt::format("{}", wavelength_um), "um",
                              fmt::format("a finite number above {} um", before_um)));
    }
    check_emissivity(fmt::format("emissivity at {} um", wavelength_um), emissivity);
    before_um = wavelength_um;
  }
}

double EmissivitySpectrum::at(double wavelength_um) const noexcept {
  if (wavelength_um <= samples_.front().wavelength_um) return samples_.front().emissivity;
  if (wavelength_um >= samples_.back().wavelength_um) return samples_.back().emissivity;
  const auto after =
      std::upper_bound(samples_.begin(), samples_.end(), wavelength_um,
                       [](double value_um, const Sample& sample) { return value_um < sample.wavelength_um; });
  const Sample& next = *after;
  const Sample& last = *(after - 1);
  const double share = (wavelength_um - last.wavelength_um) / (next.wavelength_um - last.wavelength_um);
  return last.emissivity + share * (next.emissivity - last.emissivity);
}

bool EmissivitySpectrum::covers(double begin_um, double end_um) const noexcept {
  if (samples_.size() == 1) return true;
  return samples_.front().wavelength_um <= begin_um && end_um <= samples_.back().wavelength_um;
}

std::vector<double> EmissivitySpectrum::knots_um() const {
  std::vector<double> knots;
  if (samples_.size() == 1) return knots;
  for (const Sample& sample : samples_) knots.push_back(sample.wavelength_um);
  return knots;
}

double angular_factor(AngularLaw law, double cosine) noexcept {
  const double c = cosine < 1 ? std::max(cosine, 0.0) : 1.0;  // NaN: 1
  switch (law) {
    case AngularLaw::none:
      return 1;
    case AngularLaw::soil: {
      constexpr double kLossAt60Deg = 0.02;
      return 1 - kLossAt60Deg * (1 - c) * (1 - c) / 0.25;
    }
    case AngularLaw::water:
      return water_transmitted(c) / water_transmitted(1);
  }
  return 1;
}

}  // namespace thermal
