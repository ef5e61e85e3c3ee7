#include "radiometry/radiance_table.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "accuracy/physical/assets.h"
#include "support/catch.h"

namespace radiance_table_test {

using namespace thermal;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kFloatRounding = 6e-8;  // half of a float's eps

struct NamedBand {
  const char* name;
  BandRadiance band;
};

std::vector<NamedBand> bands() {
  return {{"flat 8-14 um", BandRadiance(response("flat_8_14um"))},
          {"flat 7.5-13.5 um", BandRadiance(response("flat_7_5_13_5um"))},
          {"VOx behind germanium", BandRadiance(response("vox_germanium"))},
          {"quartz through VOx behind germanium", BandRadiance(response("vox_germanium"), quartz())}};
}

/// Temperatures unrelated to the nodes: multiples of the golden ratio.
std::vector<float> scattered_temperatures(int count, double coldest_k, double hottest_k) {
  std::vector<float> result;
  for (int i = 0; i < count; ++i) {
    const double share = i * std::numbers::phi;
    result.push_back(static_cast<float>(coldest_k + (hottest_k - coldest_k) * (share - std::floor(share))));
  }
  return result;
}

/// Largest error of a table over a range, as temperature and relative to the radiance.
struct WorstError {
  double kelvin = 0;
  double relative = 0;
};

WorstError worst_error(const RadianceTable& table, double coldest_k, double hottest_k) {
  const std::vector<float> temperature_k = scattered_temperatures(100'000, coldest_k, hottest_k);
  std::vector<float> radiance(temperature_k.size());
  table.radiances(temperature_k, radiance);
  WorstError worst;
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const BandValue exact = table.reference().evaluate(static_cast<double>(temperature_k[i]));
    const double error = std::abs(static_cast<double>(radiance[i]) - exact.radiance_w_m2_sr);
    worst.kelvin = std::max(worst.kelvin, error / exact.derivative_w_m2_sr_k);
    worst.relative = std::max(worst.relative, error / exact.radiance_w_m2_sr);
  }
  return worst;
}

}  // namespace

TEST_CASE("A table errs by less than 0.05 mK over 200 K to 400 K") {
  for (const auto& [name, band] : bands()) {
    const WorstError worst = worst_error(RadianceTable(band), 200, 400);
    CAPTURE(name, worst.relative);
    CHECK(worst.kelvin <= 5e-5);
  }
}

TEST_CASE("Nowhere in its domain does the error exceed the stated one") {
  for (const auto& [name, band] : bands()) {
    const RadianceTable table(band);
    const WorstError worst = worst_error(table, static_cast<double>(RadianceTable::kColdest),
                                         static_cast<double>(RadianceTable::kHottest));
    CAPTURE(name);
    CHECK(worst.kelvin <= table.worst_error_k());
    CHECK(worst.relative <= table.worst_relative_error());
    CHECK(table.worst_error_k() <= 5e-5);
  }
}

TEST_CASE("Outside its domain a table gives the reference's radiance, rounded") {
  const RadianceTable table(BandRadiance(response("vox_germanium")));
  const BandRadiance& band = table.reference();
  for (const float temperature_k : {1e-3F, 3.0F, 30.0F, 179.99F, 436.0F, 1000.0F, 1e6F, 1e30F}) {
    CAPTURE(temperature_k);
    CHECK(table.radiance(temperature_k) ==
          static_cast<float>(band.radiance(static_cast<double>(temperature_k))));
  }
}

TEST_CASE("It handles every temperature: 0 below 0 K, NaN for NaN, infinity for infinity") {
  const RadianceTable table(BandRadiance(response("flat_8_14um")));
  for (const float nothing : {0.0F, -0.0F, -5.0F, -kInfinity, std::numeric_limits<float>::denorm_min()}) {
    CHECK(table.radiance(nothing) == 0);
  }
  CHECK(std::isnan(table.radiance(kNaN)));
  CHECK(table.radiance(kInfinity) == kInfinity);
}

TEST_CASE("A plane with all of these in it gives the same as single pixels") {
  const RadianceTable table(BandRadiance(response("flat_8_14um")));
  std::vector<float> plane = scattered_temperatures(1000, 200, 400);
  plane[3] = kNaN;
  plane[300] = 0;
  plane[511] = 1e6F;
  plane[999] = -kInfinity;
  std::vector<float> expected;
  for (const float temperature_k : plane) expected.push_back(table.radiance(temperature_k));
  table.radiances(plane, plane);  // in place
  CHECK(std::isnan(plane[3]));
  plane[3] = expected[3] = 0;
  CHECK(plane == expected);
}

TEST_CASE("Converted back through a temperature table, temperatures return within both tables' errors") {
  const SpectralResponse flat = response("flat_8_14um");
  for (const BandRadiance& band : {BandRadiance(flat), BandRadiance(flat, quartz())}) {
    const RadianceTable forward(band);
    const TemperatureTable inverse([&band](double radiance) { return band.temperature(radiance); },
                                   band.radiance(200), band.radiance(400));
    std::vector<float> temperature_k = scattered_temperatures(10'000, 200, 400);
    std::vector<float> radiance(temperature_k.size());
    std::vector<float> back_k(temperature_k.size());
    forward.radiances(temperature_k, radiance);
    inverse.temperatures(radiance, back_k);
    double worst_k = 0;
    for (std::size_t i = 0; i < back_k.size(); ++i) {
      worst_k = std::max(worst_k, std::abs(static_cast<double>(back_k[i] - temperature_k[i])));
    }
    // A position among the nodes is a difference and a product of floats, rounded by 3e-8 of the whole span of
    // radiance three times: the slope dT/dL is steepest at 200 K. The result is a float of at most 400 K.
    const double span = band.radiance(400) - band.radiance(200);
    const double place_k = 3 * kFloatRounding * span / band.evaluate(200).derivative_w_m2_sr_k;
    const double bound_k =
        forward.worst_error_k() + inverse.worst_error_k() + place_k + 2 * 400 * kFloatRounding;
    CAPTURE(worst_k, bound_k);
    CHECK(worst_k <= bound_k);
  }
}

TEST_CASE("A table per material removes the grey-band error, which is 12 mK per kelvin for quartz") {
  const BandRadiance blackbody(response("flat_8_14um"));
  const BandRadiance surface(response("flat_8_14um"), quartz());
  const double grey_emissivity = surface.radiance(300) / blackbody.radiance(300);
  // If it were treated as grey, its radiance at 301 K would give another temperature.
  const double concluded_k = blackbody.temperature(surface.radiance(301) / grey_emissivity);
  CHECK_THAT(std::abs(concluded_k - 301) * 1e3, WithinAbs(12, 0.5));  // to the printed digits
  const RadianceTable table(surface);
  CHECK_THAT(surface.temperature(static_cast<double>(table.radiance(301))), WithinAbs(301, 5e-5));
}

}  // namespace radiance_table_test
