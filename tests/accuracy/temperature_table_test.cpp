#include "radiometry/temperature_table.h"

#include <cmath>

#include "radiometry/band_radiance.h"
#include "support/catch.h"

using namespace thermal;

namespace {

constexpr double kColdest = 180;
constexpr double kHottest = 420;
const BandRadiance kBand(SpectralResponse::flat(8, 14));

TemperatureTable night_table() {
  return TemperatureTable([](double radiance) { return kBand.temperature(radiance); },
                          kBand.radiance(kColdest), kBand.radiance(kHottest));
}

}  // namespace

TEST_CASE("The table is as good as it says, at 100000 radiances between its nodes") {
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
  CHECK(worst_k >= table.worst_error_k() - kFloat);  // nor is the claim an empty one
}

TEST_CASE("The table's error is far below what a camera can tell") {
  // A tenth of a 16-bit count of 0.01 K, and a fortieth of a camera's 40 mK.
  CHECK(night_table().worst_error_k() < 1e-3);
}
