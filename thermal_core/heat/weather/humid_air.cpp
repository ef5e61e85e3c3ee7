#include "heat/weather/humid_air.h"

#include <algorithm>
#include <cmath>

namespace thermal {
namespace {

constexpr double kZeroCelsiusK = 273.15;
constexpr double kColdestSaturationK = 190;
constexpr double kHottestSaturationK = 420;
constexpr double kMagnus = 17.62;
constexpr double kMagnusC = 243.12;

}  // namespace

double pressure_hpa(double elevation_m) noexcept {
  return 1013.25 * std::pow(1 - 2.25577e-5 * elevation_m, 5.25588);
}

double air_density_kg_m3(double pressure_hpa, double temperature_k) noexcept {
  constexpr double kGasJKgK = 287.05;
  return 100 * pressure_hpa / (kGasJKgK * temperature_k);
}

double saturation_hpa(double temperature_k) noexcept {
  const double celsius = std::clamp(temperature_k, kColdestSaturationK, kHottestSaturationK) - kZeroCelsiusK;
  return 6.112 * std::exp(kMagnus * celsius / (kMagnusC + celsius));
}

double saturation_slope_hpa_k(double temperature_k, double saturated_hpa) noexcept {
  if (!(temperature_k > kColdestSaturationK && temperature_k < kHottestSaturationK)) return 0;
  const double scale = kMagnusC + temperature_k - kZeroCelsiusK;
  return saturated_hpa * kMagnus * kMagnusC / (scale * scale);
}

double specific_humidity(double vapour_hpa, double pressure_hpa) noexcept {
  return 0.622 * vapour_hpa / pressure_hpa;
}

}  // namespace thermal
