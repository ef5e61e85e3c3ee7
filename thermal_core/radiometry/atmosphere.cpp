#include "radiometry/atmosphere.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace thermal {
namespace {

constexpr double kZeroCelsius = 273.15;

constexpr double kLongest = 1000;  // m; path_transmittance() is Beer's law below kShortest
constexpr double kShortest = 30;

/// The published fit, clamped to where a transmittance can be.
double fitted_transmittance(const Air& air, double range_m) noexcept {
  constexpr double kWeight = 1.9;
  const double root_range = std::sqrt(range_m);
  const double root_water = std::sqrt(path_water_g_m3(air));
  const double first = std::exp(-root_range * (0.006569 - 0.002276 * root_water));
  const double second = std::exp(-root_range * (0.01262 - 0.00667 * root_water));
  return std::clamp(kWeight * first + (1 - kWeight) * second, 0.0, 1.0);
}

}  // namespace

void Air::validate() const {
  require_range("weather.air_temperature_k", temperature_k, "K", kColdestAirK, kHottestAirK);
  require_range("weather.relative_humidity", relative_humidity, "", 0, 1);
  require_range("weather.cloud_fraction", cloud_fraction, "", 0, 1);
  require_range("weather.inversion_k", inversion_k, "K", 0, kLargestInversionK);
}

double vapour_pressure_hpa(const Air& air) noexcept {
  const double celsius = air.temperature_k - kZeroCelsius;
  return air.relative_humidity * 6.112 * std::exp(17.62 * celsius / (243.12 + celsius));
}

double path_water_g_m3(const Air& air) noexcept {
  constexpr double kMost = 25;
  const double t = air.temperature_k - kZeroCelsius;
  const double content =
      air.relative_humidity * std::exp(1.5587 + 0.06939 * t - 2.7816e-4 * t * t + 6.8455e-7 * t * t * t);
  return std::min(content, kMost);
}

double path_transmittance(const Air& air, double range_m) noexcept {
  const double range = range_m < kLongest ? std::max(range_m, 0.0) : kLongest;  // NaN: the longest
  if (range < kShortest) return std::pow(fitted_transmittance(air, kShortest), range / kShortest);
  return fitted_transmittance(air, range);
}

double clear_zenith_emissivity(const Air& air) noexcept {
  const double e = vapour_pressure_hpa(air);
  return std::min(1.0, 0.24 + 2.98e-8 * e * e * std::exp(3000 / air.temperature_k));
}

double clear_sky_emissivity(const Air& air) noexcept {
  const double zenith = clear_zenith_emissivity(air);
  return zenith * (1.4 - 0.4 * zenith);
}

}  // namespace thermal
