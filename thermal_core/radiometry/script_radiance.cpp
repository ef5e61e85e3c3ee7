#include "radiometry/script_radiance.h"

#include <cmath>

namespace thermal {

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
