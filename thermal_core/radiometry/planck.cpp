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

}  // namespace thermal
