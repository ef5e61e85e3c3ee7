#include "radiometry/planck.h"

#include <cassert>
#include <cmath>

namespace thermal {

double planck_radiance(double wavelength_um, double temperature_k) noexcept {
  assert(wavelength_um > 0);
  if (temperature_k <= 0) return 0;
  const double wavelength_m = wavelength_um * 1e-6;
  const double x = kSecondRadiationConstant / (wavelength_m * temperature_k);
  const double per_metre = kFirstRadiationConstant / (std::pow(wavelength_m, 5) * std::expm1(x));
  return per_metre * 1e-6;
}

double script_radiance(double temperature_k) noexcept {
  if (temperature_k <= 0) return 0;
  constexpr double kC1 = 1.19104e8;
  constexpr double kC2 = 1.43879e4;
  constexpr int kPoints = 600;
  constexpr double kStepUm = 0.01;
  const auto planck = [temperature_k](int point) {
    const double wavelength_um = 8.0 + kStepUm * point;
    return kC1 / (std::pow(wavelength_um, 5) * (std::exp(kC2 / (wavelength_um * temperature_k)) - 1));
  };
  double sum = (planck(0) + planck(kPoints - 1)) / 2;
  for (int point = 1; point < kPoints - 1; ++point) sum += planck(point);
  return sum * kStepUm;
}

}  // namespace thermal
