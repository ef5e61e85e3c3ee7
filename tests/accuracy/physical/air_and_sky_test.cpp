#include <cmath>
#include <limits>

#include "base/error.h"
#include "radiometry/atmosphere.h"
#include "radiometry/spectral_air.h"
#include "support/catch.h"
#include "support/golden.h"
#include "support/message_of.h"

namespace air_and_sky_test {

using namespace thermal;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Formulas of a dozen operations on numbers of order 1 to 10, with exponents up to 20 that magnify a rounding by the
// same factor: (12 + 20) eps / 2 = 4e-15 relative.
constexpr double kRounding = 4e-15;

constexpr Air kWinter = {273, 0.6, 0};
constexpr Air kSummer = {293, 0.7, 0};
constexpr Air kDry = {283, 0, 0};
constexpr Air kTropics = {308, 0.9, 0};  // 35 g m^-3 of water, were it not clamped to 25

}  // namespace

TEST_CASE("Vapour, water content and sky agree with independently computed published formulas") {
  const auto rows = read_golden("air_and_sky.csv");
  CHECK(rows.size() == 21);
  for (const GoldenRow& row : rows) {
    const auto& n = row.numbers;
    const Air air = {n[0], n[1], n[2]};
    CAPTURE(n[0], n[1], n[2]);
    CHECK_THAT(vapour_pressure_hpa(air), WithinRel(n[3], kRounding));
    CHECK_THAT(path_water_g_m3(air), WithinRel(n[4], kRounding));
    // A sky is opaque but for 1e-9, for the factor to be finite.
    const BandAir band_air(air, SpectralResponse::flat(8, 14));
    CHECK_THAT(band_air.sky_emissivity(1), WithinAbs(n[5], 2e-9));
    CHECK_THAT(band_air.sky_emissivity(), WithinAbs(n[6], 2e-9));
  }
}

TEST_CASE("Transmittance of paths of 0 to 1500 m agrees with them too") {
  const auto rows = read_golden("path_transmittance.csv");
  CHECK(rows.size() == 77);
  for (const GoldenRow& row : rows) {
    const auto& n = row.numbers;
    CAPTURE(n[0], n[1], n[2]);
    // Two exponentials weighted 1.9 and -0.9: below 2.8 times the rounding of each, absolutely.
    CHECK_THAT(path_transmittance({n[0], n[1], 0}, n[2]), WithinAbs(n[3], 2.8 * kRounding));
  }
}

TEST_CASE("Path length is clamped to 0 to 1000 m") {
  for (const Air& air : {kWinter, kSummer, kDry, kTropics}) {
    CHECK(path_transmittance(air, 0) == 1);
    CHECK(path_transmittance(air, -5) == 1);
    CHECK(path_transmittance(air, -kInfinity) == 1);
    const double farthest = path_transmittance(air, 1000);
    CHECK(path_transmittance(air, 1e6) == farthest);
    CHECK(path_transmittance(air, kInfinity) == farthest);
    CHECK(path_transmittance(air, kNaN) == farthest);
  }
}

TEST_CASE("Water content above the fit's range changes nothing") {
  CHECK(path_water_g_m3(kTropics) == 25);
  CHECK(path_transmittance(kTropics, 500) == path_transmittance({318, 1, 0}, 500));
}

TEST_CASE("Transmittance falls with range from 1, without a jump, and stays in [0, 1]") {
  for (const Air& air : {kWinter, kSummer, kDry, kTropics}) {
    double before = 1;
    for (int step = 1; step <= 10000; ++step) {
      const double range_m = 0.1 * step;
      const double here = path_transmittance(air, range_m);
      CAPTURE(air.temperature_k, air.relative_humidity, range_m);
      REQUIRE((here < before || here == 0));  // a saturated kilometre is opaque
      // Steepest at 0: by the fit itself -ln tau(30 m) / 30 m < 0.01 a metre at 25 g m^-3, 0.001 in 0.1 m.
      REQUIRE(before - here < 1e-3);
      REQUIRE(here >= 0);
      before = here;
    }
  }
}

TEST_CASE("Beer's law and the fit agree where they meet, at 30 m") {
  for (const Air& air : {kWinter, kSummer, kDry, kTropics}) {
    // Slopes are below 0.01 per metre, so 1e-9 m to either side differ by at most 2e-11, and rounding is far smaller.
    const double step = path_transmittance(air, 30 - 1e-9) - path_transmittance(air, 30 + 1e-9);
    CHECK(std::abs(step) < 2e-11);
  }
}

TEST_CASE("Transmittance falls with the air's water content") {
  CHECK(path_transmittance(kDry, 100) > path_transmittance(kWinter, 100));
  CHECK(path_transmittance(kWinter, 100) > path_transmittance(kSummer, 100));
  CHECK(path_transmittance(kSummer, 100) > path_transmittance(kTropics, 100));
}

TEST_CASE("The sky is darkest at the zenith, and brighter over the hemisphere") {
  for (const Air& air : {kWinter, kSummer, kDry}) {
    CHECK(clear_zenith_emissivity(air) < clear_sky_emissivity(air));
    CHECK(clear_sky_emissivity(air) < 1);
  }
  CHECK(clear_zenith_emissivity(kDry) == 0.24);
}

TEST_CASE("Humid heat closes the sky's window, and its emissivity never exceeds 1") {
  const Air jungle = {318, 1, 0};
  CHECK(clear_zenith_emissivity(jungle) == 1);
  CHECK_THAT(clear_sky_emissivity(jungle), WithinAbs(1, kRounding));
}

TEST_CASE("Impossible air is an error") {
  const auto fault_of = [](const Air& air) { return message_of<ConfigError>([&] { air.validate(); }); };
  CHECK(fault_of({232, 0.5, 0}) == "weather.air_temperature_k = 232 K; expected 233 to 323 K");
  CHECK(fault_of({kNaN, 0.5, 0}) == "weather.air_temperature_k = nan K; expected 233 to 323 K");
  CHECK(fault_of({273, 1.5, 0}) == "weather.relative_humidity = 1.5; expected 0 to 1");
  CHECK(fault_of({273, 0.5, -0.1}) == "weather.cloud_fraction = -0.1; expected 0 to 1");
  CHECK_NOTHROW(Air{233, 0, 1}.validate());
  CHECK_NOTHROW(Air{323, 1, 0}.validate());
}

}  // namespace air_and_sky_test
