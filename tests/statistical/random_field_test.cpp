#include <array>
#include <cmath>
#include <vector>

#include "base/rng.h"
#include "support/catch.h"

namespace random_field_test {

using namespace thermal;

namespace {

constexpr std::size_t kCount = std::size_t{1} << 21;
constexpr auto kN = static_cast<double>(kCount);
constexpr double kSigmas = 5;  // for a good generator, one check in 1.7 million fails

constexpr RandomField kField = {.seed = 7, .stream = 1, .clip = hash_name("clip"), .frame = 100};

std::vector<float> normals(const RandomField& field) {
  std::vector<float> values(kCount);
  fill_normal(field, 0, values);
  return values;
}

std::vector<float> uniforms(const RandomField& field) {
  std::vector<float> values(kCount);
  fill_uniform(field, 0, values);
  return values;
}

/// Mean of the values' power.
double moment(const std::vector<float>& values, int power) {
  double sum = 0;
  for (const float value : values) sum += std::pow(static_cast<double>(value), power);
  return sum / static_cast<double>(values.size());
}

/// Mean of the products of two fields' values, the second shifted by `lag`: their correlation, for normals.
double correlation(const std::vector<float>& a, const std::vector<float>& b, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = lag; i < a.size(); ++i) {
    sum += static_cast<double>(a[i]) * static_cast<double>(b[i - lag]);
  }
  return sum / static_cast<double>(a.size() - lag);
}

/// Difference of chi-square of equally likely bins from its mean, in standard deviations.
template <std::size_t Bins>
double chi_square_sigmas(const std::array<int, Bins>& counts) {
  double total = 0;
  for (const int count : counts) total += count;
  const double expected = total / Bins;
  double chi_square = 0;
  for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
  constexpr double kFreedoms = Bins - 1;
  return (chi_square - kFreedoms) / std::sqrt(2 * kFreedoms);
}

}  // namespace

TEST_CASE("Normal numbers have a normal distribution's moments") {
  const std::vector<float> values = normals(kField);
  // Variances of the n-value means of z, z^2, z^3 and z^4: 1, 2, 15 and 96, over n.
  CHECK_THAT(moment(values, 1), WithinAbs(0, kSigmas * std::sqrt(1 / kN)));
  CHECK_THAT(moment(values, 2), WithinAbs(1, kSigmas * std::sqrt(2 / kN)));
  CHECK_THAT(moment(values, 3), WithinAbs(0, kSigmas * std::sqrt(15 / kN)));
  CHECK_THAT(moment(values, 4), WithinAbs(3, kSigmas * std::sqrt(96 / kN)));
}

TEST_CASE("Normal numbers have a normal distribution's shape") {
  std::array<int, 128> bins{};
  for (const float value : normals(kField)) {
    const double share = std::erfc(-static_cast<double>(value) / std::sqrt(2.0)) / 2;  // uniform, if normal
    ++bins[std::min<std::size_t>(127, static_cast<std::size_t>(share * 128))];
  }
  CHECK(std::abs(chi_square_sigmas(bins)) < kSigmas);
}

TEST_CASE("Normal numbers have the tails of a normal distribution") {
  const double threshold = GENERATE(3.0, 4.0);
  double beyond = 0;
  for (const float value : normals(kField))
    beyond += std::abs(static_cast<double>(value)) > threshold ? 1 : 0;
  const double expected = kN * std::erfc(threshold / std::sqrt(2.0));
  CHECK_THAT(beyond, WithinAbs(expected, kSigmas * std::sqrt(expected)));  // a rare event: Poisson's variance
}

TEST_CASE("Neighbours in a field are uncorrelated") {
  const std::vector<float> values = normals(kField);
  // Up to a row of 640 px; the lags between are those of one Philox block and of one batch of 64.
  const auto lag = GENERATE(as<std::size_t>{}, 1, 2, 3, 4, 63, 64, 640);
  CHECK_THAT(correlation(values, values, lag), WithinAbs(0, kSigmas / std::sqrt(kN)));
}

TEST_CASE("Neighbouring fields are uncorrelated") {
  RandomField other = kField;
  SECTION("the next frame") { other.frame += 1; }
  SECTION("the next seed") { other.seed += 1; }
  SECTION("the next stream") { other.stream += 1; }
  SECTION("another clip") { other.clip = hash_name("clip2"); }
  CHECK_THAT(correlation(normals(kField), normals(other), 0), WithinAbs(0, kSigmas / std::sqrt(kN)));
}

TEST_CASE("The two numbers of a Box-Muller pair are uncorrelated, and so are their squares") {
  const std::vector<float> values = normals(kField);
  double product = 0;
  double product_of_squares = 0;
  for (std::size_t i = 0; i < kCount; i += 2) {
    const double a = static_cast<double>(values[i]);
    const double b = static_cast<double>(values[i + 1]);
    product += a * b;
    product_of_squares += (a * a - 1) * (b * b - 1);
  }
  // Variances of one term: 1, and 2 * 2.
  CHECK_THAT(product / (kN / 2), WithinAbs(0, kSigmas * std::sqrt(1 / (kN / 2))));
  CHECK_THAT(product_of_squares / (kN / 2), WithinAbs(0, kSigmas * std::sqrt(4 / (kN / 2))));
}

TEST_CASE("Uniform numbers are evenly spread") {
  std::array<int, 256> bins{};
  for (const float value : uniforms(kField)) ++bins.at(static_cast<std::size_t>(value * 256));
  CHECK(std::abs(chi_square_sigmas(bins)) < kSigmas);
}

TEST_CASE("Pairs of neighbouring uniform numbers are evenly spread over the square") {
  const std::vector<float> values = uniforms(kField);
  std::array<int, 1024> bins{};
  for (std::size_t i = 0; i < kCount; i += 2) {
    ++bins[32 * static_cast<std::size_t>(values[i] * 32) + static_cast<std::size_t>(values[i + 1] * 32)];
  }
  CHECK(std::abs(chi_square_sigmas(bins)) < kSigmas);
}

TEST_CASE("The lowest bits of uniform numbers are as random as the highest") {
  std::array<int, 256> bins{};
  for (const float value : uniforms(kField)) ++bins[static_cast<std::size_t>(value * 16777216.0F) % 256];
  CHECK(std::abs(chi_square_sigmas(bins)) < kSigmas);
}

}  // namespace random_field_test
