#include <cmath>

#include "radiometry/band_radiance.h"
#include "radiometry/radiance_table.h"
#include "support/catch.h"

namespace temperature_table_test {

using namespace thermal;

namespace {

constexpr double kColdest = 180;
constexpr double kHottest = 420;
const BandRadiance kBand(SpectralResponse::flat(8, 14));

TemperatureTable night_table() {
  return TemperatureTable([](double radiance) { return kBand.temperature(radiance); },
                          kBand.radiance(kColdest), kBand.radiance(kHottest), kBand.radiance(2000));
}

}  // namespace

TEST_CASE("The table meets its stated error at 100000 radiances between its nodes") {
  constexpr int kPoints = 100000;
  const TemperatureTable table = night_table();
  std::vector<float> radiances;
  for (int i = 0; i < kPoints; ++i) {
    const double temperature_k = kColdest + (kHottest - kColdest) * (i + 0.5) / kPoints;
    radiances.push_back(static_cast<float>(kBand.radiance(temperature_k)));
  }
  std::vector<float> temperatures(radiances.size());
  table.temperatures(radiances, temperatures);
  double worst_k = 0;
  for (std::size_t i = 0; i < radiances.size(); ++i) {
    const double exact_k = kBand.temperature(static_cast<double>(radiances[i]));
    worst_k = std::max(worst_k, std::abs(static_cast<double>(temperatures[i]) - exact_k));
  }
  // Single precision steps by 3.1e-5 K at 420 K. Three results are rounded, half a step each, and the position,
  // good to 8192 eps of a node step of 0.01 K, adds 1e-5 K.
  constexpr double kFloat = 3 * 1.53e-5 + 1e-5;
  CAPTURE(worst_k, table.worst_error_k());
  CHECK(worst_k <= table.worst_error_k() + kFloat);
  CHECK(worst_k >= table.worst_error_k() - kFloat);  // the stated error is not empty either
}

TEST_CASE("The table's error is far below a camera's resolution") {
  // A tenth of a 16-bit count of 0.01 K, and a fortieth of a camera's 40 mK.
  CHECK(night_table().worst_error_k() < 1e-3);
}

TEST_CASE("The hot part errs by a fifth of a millikelvin at most, 420 to 2000 K") {
  constexpr int kPoints = 100000;
  const TemperatureTable table = night_table();
  double worst_k = 0;
  for (int i = 0; i < kPoints; ++i) {
    const auto radiance =
        static_cast<float>(kBand.radiance(kHottest + (2000 - kHottest) * (i + 0.5) / kPoints));
    float temperature_k = 0;
    table.temperatures({&radiance, 1}, {&temperature_k, 1});
    const double exact_k = kBand.temperature(static_cast<double>(radiance));
    worst_k = std::max(worst_k, std::abs(static_cast<double>(temperature_k) - exact_k));
  }
  // Lines: h^2 / 8 |T''|, h = L / 1024 at most, and T goes as L^(1/k), so that L^2 |T''| = T (1/k) (1 - 1/k) <= T / 4:
  // 6.0e-5 K at 2000 K. Single precision steps by 1.22e-4 K there: half a step of each node and of the result.
  CAPTURE(worst_k);
  CHECK(worst_k <= 6.0e-5 + 1.22e-4 + 1e-6);
  CHECK(worst_k >= 6.1e-5);  // half a step: nothing of single precision is better
}

TEST_CASE("Where the two parts meet they agree to their errors") {
  const TemperatureTable table = night_table();
  auto radiance = static_cast<float>(kBand.radiance(kHottest));
  std::vector<float> radiances;
  for (int i = 0; i < 8; ++i) radiance = std::nextafter(radiance, 0.0F);
  for (int i = 0; i < 16; ++i) radiances.push_back(radiance = std::nextafter(radiance, 1e9F));
  std::vector<float> temperatures(radiances.size());
  table.temperatures(radiances, temperatures);
  for (const float temperature_k : temperatures) {
    // 16 floats of radiance are 16 * 1.5e-5 / 2.1 W m^-2 sr^-1 K^-1.
    CHECK_THAT(static_cast<double>(temperature_k), WithinAbs(kHottest, 2e-4 + table.worst_error_k()));
  }
}

}  // namespace temperature_table_test
