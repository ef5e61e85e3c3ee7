#include "radiometry/band_radiance.h"

#include <cmath>
#include <map>

#include "support/catch.h"
#include "support/golden.h"

namespace band_radiance_test {

using namespace thermal;

namespace {

constexpr double kRounding = 1.11e-16;  // half of eps: the largest relative change by one operation

const BandRadiance kBand(SpectralResponse::flat(8, 14));

/// Relative error bound of a radiance whose relative rise with relative temperature is `condition` = T L'/L.
/// The temperature as read, c2, T / c2, the wavenumber at the band's end and x carry five roundings, and so does
/// x0 - x: 6 condition. The factors of one summand carry 20 roundings, the weights of 12 points, all positive,
/// at most 12 more a panel; 2 panels of width 4 hold all but e^-8 of the integral.
double radiance_bound(double condition) { return (6 * condition + 20 + 2 * 12) * kRounding; }

struct Golden {
  double temperature_k;
  double radiance;
  double derivative;
  double ln_radiance;

  [[nodiscard]] double condition() const { return temperature_k * derivative / radiance; }
};

std::vector<Golden> golden_from(double coldest_k) {
  std::vector<Golden> result;
  for (const GoldenRow& row : read_golden("band_radiance_8_14um.csv")) {
    const auto& n = row.numbers;
    if (n[0] >= coldest_k) result.push_back({n[0], n[1], n[2], n[3]});
  }
  return result;
}

const std::map<std::string, std::vector<SpectralResponse::Sample>> kResponses = {
    {"10nm", {{10.0, 1}, {10.01, 1}}},
    {"1pm", {{10.0, 1}, {10.000001, 1}}},
    {"triangle", {{8.0, 0}, {10.5, 1}, {14.0, 0}}},
    {"zero_ends", {{7.0, 0}, {7.5, 0}, {9.0, 1}, {12.0, 0.5}, {13.5, 0}, {20.0, 0}}},
    {"gap", {{8.0, 1}, {9.0, 0}, {11.0, 0}, {12.5, 0.8}, {14.0, 1}}}};

}  // namespace

// The worst measured error is 1.5e-15, at 263.15 K; the next test has the bound that theory guarantees.
TEST_CASE("Golden radiances, 30 K and up, to 1e-12") {
  const std::vector<Golden> goldens = golden_from(30);
  CHECK(goldens.size() == 16);
  for (const Golden& golden : goldens) {
    CAPTURE(golden.temperature_k);
    CHECK_THAT(kBand.radiance(golden.temperature_k), WithinRel(golden.radiance, 1e-12));
  }
}

TEST_CASE("Golden radiances and derivatives agree to the rounding of their inputs, where representable") {
  const std::vector<Golden> goldens = golden_from(3);
  CHECK(goldens.size() == 18);
  for (const Golden& golden : goldens) {
    CAPTURE(golden.temperature_k);
    const BandValue value = kBand.evaluate(golden.temperature_k);
    const double bound = radiance_bound(golden.condition());
    CHECK_THAT(value.radiance_w_m2_sr, WithinRel(golden.radiance, bound));
    // The derivative's summands have x / (1 - e^-x) as a factor more: condition + 1 at most, 5 roundings.
    CHECK_THAT(value.derivative_w_m2_sr_k, WithinRel(golden.derivative, bound + 11 * kRounding));
  }
}

TEST_CASE("Golden logarithms agree, also where the radiance underflows a double") {
  const std::vector<Golden> goldens = golden_from(1);
  CHECK(goldens.size() == 19);
  for (const Golden& golden : goldens) {
    CAPTURE(golden.temperature_k);
    // An absolute error of the logarithm is a relative one of the radiance; at 1 K the condition is the x at the
    // long-wave end. Three logarithms are added, which rounds by their own sizes.
    const double x0 = 14387.77 / (14 * golden.temperature_k);
    const double bound = radiance_bound(x0 + 4) + 3 * (std::abs(golden.ln_radiance) + 40) * kRounding;
    CHECK_THAT(kBand.evaluate(golden.temperature_k).ln_radiance, WithinAbs(golden.ln_radiance, bound));
  }
}

TEST_CASE("Bands of any shape and width agree with 60-digit arithmetic") {
  for (const GoldenRow& row : read_golden("band_radiance_responses.csv")) {
    const BandRadiance band((SpectralResponse(kResponses.at(row.texts[0]))));
    const double temperature_k = row.numbers[1];
    CAPTURE(row.texts[0], temperature_k);
    const BandValue value = band.evaluate(temperature_k);
    const double condition = temperature_k * value.derivative_w_m2_sr_k / value.radiance_w_m2_sr;
    // Four segments at most, whose 12 points a panel add up one after another.
    CHECK_THAT(value.radiance_w_m2_sr, WithinRel(row.numbers[2], radiance_bound(condition) + 48 * kRounding));
  }
}

TEST_CASE("The inverse undoes the forward function through the logarithm, 1 K to 1e5 K") {
  double worst_k = 0;
  for (double temperature_k = 1; temperature_k <= 1e5; temperature_k *= 1.01) {
    const BandValue value = kBand.evaluate(temperature_k);
    const double back_k = kBand.temperature_from_ln(value.ln_radiance);
    worst_k = std::max(worst_k, std::abs(back_k - temperature_k));
    // d ln L = condition dT / T. The forward way runs once and, inside the inverse, once more; the logarithm's
    // own rounding is relative to it and to the logarithms of nu / x it is made of, at most 40.
    const double x0 = 14387.77 / (14 * temperature_k);
    const double condition = std::max(1.0, x0);
    const double ln_bound = radiance_bound(x0 + 4) + 3 * (std::abs(value.ln_radiance) + 40) * kRounding;
    // Newton stops at 4 eps of 1 / T.
    const double bound_k = temperature_k * (2 * ln_bound / condition + 8 * 2 * kRounding);
    CAPTURE(temperature_k, bound_k);
    REQUIRE_THAT(back_k, WithinAbs(temperature_k, bound_k));
  }
  CHECK(worst_k <= 1e-6);
}

TEST_CASE("The inverse undoes the forward function wherever the radiance is a normal double") {
  double worst_k = 0;
  for (double temperature_k = 1.4485; temperature_k <= 1e5; temperature_k *= 1.01) {
    const BandValue value = kBand.evaluate(temperature_k);
    const double back_k = kBand.temperature(value.radiance_w_m2_sr);
    worst_k = std::max(worst_k, std::abs(back_k - temperature_k));
    const double condition = temperature_k * value.derivative_w_m2_sr_k / value.radiance_w_m2_sr;
    const double bound_k = temperature_k * (2 * radiance_bound(condition) / condition + 2 * kRounding);
    CAPTURE(temperature_k, bound_k);
    REQUIRE_THAT(back_k, WithinAbs(temperature_k, bound_k));
  }
  CHECK(worst_k <= 1e-6);
}

TEST_CASE("Golden radiances give back their temperatures to 1e-6 K") {
  for (const Golden& golden : golden_from(1)) {
    CAPTURE(golden.temperature_k);
    const double back_k = golden.temperature_k < 1.5 ? kBand.temperature_from_ln(golden.ln_radiance)
                                                     : kBand.temperature(golden.radiance);
    CHECK_THAT(back_k, WithinAbs(golden.temperature_k, 1e-6));
  }
}

}  // namespace band_radiance_test
