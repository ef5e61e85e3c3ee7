#include "heat/weather/humid_air.h"

#include <cmath>

#include "heat/surface/surface_balance.h"
#include "support/catch.h"

namespace humid_air_test {

using namespace thermal;

namespace {

/// Saturation over water [hPa], also supercooled, within 0.05 % from 123 K to 332 K (Murphy and Koop, QJRMS 131, 1539,
/// 2005, equation 10).
double murphy_and_koop_hpa(double t_k) {
  const double log_pa =
      54.842763 - 6763.22 / t_k - 4.210 * std::log(t_k) + 0.000367 * t_k +
      std::tanh(0.0415 * (t_k - 218.8)) * (53.878 - 1331.22 / t_k - 9.44523 * std::log(t_k) + 0.014025 * t_k);
  return std::exp(log_pa) / 100;
}

}  // namespace

TEST_CASE("Vapour at saturation is within 0.3 % of Murphy and Koop above 260 K") {
  for (double t_k = 260; t_k <= 332; t_k += 1) {
    CAPTURE(t_k);
    CHECK_THAT(saturation_hpa(t_k), WithinRel(murphy_and_koop_hpa(t_k), 0.003 + 0.0005));
  }
}

TEST_CASE("Vapour at saturation is within 0.8 % of Murphy and Koop down to 228 K") {
  for (double t_k = 228; t_k < 260; t_k += 1)
    CHECK_THAT(saturation_hpa(t_k), WithinRel(murphy_and_koop_hpa(t_k), 0.008));
}

TEST_CASE("Its slope is that of its difference, and 0 where it is clamped") {
  for (const double t_k : {191.0, 230.0, 273.15, 300.0, 419.0}) {
    CAPTURE(t_k);
    const double step_k = 0.01;
    const double difference = (saturation_hpa(t_k + step_k) - saturation_hpa(t_k - step_k)) / (2 * step_k);
    // Of third order: at most 0.15 / K, squared and by 0.01^2 / 6; and rounding of 1e-16 / 0.01.
    CHECK_THAT(saturation_slope_hpa_k(t_k, saturation_hpa(t_k)), WithinRel(difference, 1e-6));
  }
  CHECK(saturation_slope_hpa_k(150, saturation_hpa(150)) == 0);
  CHECK(saturation_slope_hpa_k(500, saturation_hpa(500)) == 0);
  CHECK(saturation_hpa(150) == saturation_hpa(190));
  CHECK(saturation_hpa(500) == saturation_hpa(420));
  CHECK(std::isnan(saturation_hpa(std::nan(""))));
}

TEST_CASE("Pressure is that of the standard atmosphere") {
  // ISO 2533, by geopotential height, as printed; exponent and lapse are given to six digits: 1e-6 of the logarithm.
  CHECK(pressure_hpa(0) == 1013.25);
  CHECK_THAT(pressure_hpa(1000), WithinAbs(898.746, 0.0005 + 0.002));
  CHECK_THAT(pressure_hpa(5000), WithinAbs(540.199, 0.0005 + 0.005));
  CHECK_THAT(air_density_kg_m3(1013.25, 288.15), WithinAbs(1.225, 0.0005));
}

TEST_CASE("Leaves and bodies exchange heat by their published formulas") {
  CHECK_THAT(leaf_resistance_s_m(0.01, 1), WithinRel(5.0, 1e-15));  // 100 sqrt(0.01) / 2
  CHECK_THAT(leaf_resistance_s_m(0.04, 4), WithinRel(5.0, 1e-15));
  CHECK(leaf_resistance_s_m(0.01, 0) == leaf_resistance_s_m(0.01, 0.15));
  CHECK_THAT(body_exchange(0), WithinRel(2.8, 1e-15));
  CHECK_THAT(body_exchange(5), WithinRel(17.8, 1e-15));
}

}  // namespace humid_air_test
