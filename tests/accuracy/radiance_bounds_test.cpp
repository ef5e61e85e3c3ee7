#include <algorithm>
#include <cmath>
#include <cstdint>

#include "radiometry/band_radiance.h"
#include "radiometry/radiance_table.h"
#include "support/catch.h"
#include "support/golden.h"

namespace radiance_bounds_test {

using namespace thermal;

namespace {

/// The samples of radiance_bounds.py: doubles nearest to its decimals.
SpectralResponse sampled(const std::string& shape, std::int64_t count) {
  std::vector<SpectralResponse::Sample> samples;
  std::int64_t state = 1;
  for (std::int64_t i = 0; i <= count; ++i) {
    state = (1103515245 * state + 12345) % (std::int64_t{1} << 31);
    const std::int64_t millionths =
        shape == "smooth" ? 4'000'000 * i * (count - i) / (count * count) : (state >> 16) % 1000 * 1000;
    samples.push_back({static_cast<double>(7'500'000 + i * (6'000'000 / count)) / 1e6,
                       static_cast<double>(millionths) / 1e6});
  }
  return SpectralResponse(std::move(samples));
}

/// A radiance computed with 60 digits from inputs as they are written, and those inputs as doubles.
struct Golden {
  SpectralResponse response;
  std::int64_t samples;  ///< 0: a flat band
  double temperature_k;
  double radiance;

  /// How far off a radiance is.
  [[nodiscard]] double relative_error(double value) const { return std::abs(value / radiance - 1); }
};

std::vector<Golden> goldens(std::int64_t most_samples = 1'000'000) {
  std::vector<Golden> result;
  for (const GoldenRow& row : read_golden("radiance_bounds.csv")) {
    const auto count = static_cast<std::int64_t>(row.numbers[3]);
    if (count > most_samples) continue;
    result.push_back({.response = count == 0 ? SpectralResponse::flat(row.numbers[0], row.numbers[1])
                                             : sampled(row.texts[2], count),
                      .samples = count,
                      .temperature_k = row.numbers[4],
                      .radiance = row.numbers[5]});
  }
  return result;
}

}  // namespace

// The golden value itself is rounded to a double: one u on top.
constexpr double kGoldenRounding = 1.2e-16;

TEST_CASE("The stated bound of the reference holds for narrow, wide, cold, hot and million-sample bands") {
  int tested = 0;
  for (const Golden& golden : goldens()) {
    const BandRadiance band(golden.response);
    const double bound = band.relative_error_bound(golden.temperature_k);
    CAPTURE(golden.response.begin_um(), golden.response.end_um(), golden.samples, golden.temperature_k,
            bound);
    CHECK(golden.relative_error(band.radiance(golden.temperature_k)) <= bound + kGoldenRounding);
    ++tested;
  }
  CHECK(tested == 88);
}

TEST_CASE("The bound is no larger than its derivation says") {
  const auto bound = [](double begin_um, double end_um, double temperature_k) {
    return BandRadiance(SpectralResponse::flat(begin_um, end_um)).relative_error_bound(temperature_k);
  };
  // u (14 kappa + 100 + V): kappa 4.6 and V 3.2 at 300 K; 2 lambda / width = 2e4 of 1 nm, 2e7 of 1 pm.
  CHECK_THAT(bound(8, 14, 300), WithinRel(1.86e-14, 0.02));
  CHECK_THAT(bound(10, 10.001, 300), WithinRel(2.24e-12, 0.02));
  CHECK_THAT(bound(10, 10.000001, 300), WithinRel(2.22e-9, 0.02));
  // A parabola's V is its total variation, 2, and not that of its samples.
  CHECK(BandRadiance(sampled("smooth", 100'000)).relative_error_bound(300) < 2e-14);
}

TEST_CASE("Sums of a million samples lose no more than sums of ten") {
  for (const Golden& golden : goldens()) {
    if (golden.samples != 1'000'000) continue;
    const double error = golden.relative_error(BandRadiance(golden.response).radiance(golden.temperature_k));
    CHECK(error < 1e-14);  // 7e-14 when they were added up one by one; what is left is that of the inputs
  }
}

TEST_CASE("The stated bound of the table holds inside and outside it") {
  for (const Golden& golden : goldens(10)) {
    const RadianceTable table((BandRadiance(golden.response)));
    const auto value = static_cast<double>(table.radiance(static_cast<float>(golden.temperature_k)));
    const double bound = table.relative_error_bound(golden.temperature_k);
    CAPTURE(golden.response.begin_um(), golden.response.end_um(), golden.samples, golden.temperature_k,
            bound);
    CHECK(golden.relative_error(value) <= bound);
  }
}

TEST_CASE("Bounds at the edges of the domain") {
  const BandRadiance band(SpectralResponse::flat(8, 14));
  CHECK(band.relative_error_bound(0) == 0);
  CHECK(band.relative_error_bound(-1) == 0);
  CHECK(std::isnan(band.relative_error_bound(std::nan(""))));
  CHECK(band.relative_error_bound(1) == 1);       // 1e-442: 0 is all that a double can say
  CHECK(band.relative_error_bound(1.4) > 1e-12);  // denormal: fewer digits
  CHECK(band.relative_error_bound(1.4) < 1);
  const RadianceTable table(band);
  CHECK(table.relative_error_bound(0) == 0);
  CHECK(table.relative_error_bound(5) == 1);  // 2e-88, below the smallest float
}

}  // namespace radiance_bounds_test
