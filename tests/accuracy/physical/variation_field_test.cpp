#include "scene/variation_field.h"

#include <cmath>
#include <limits>

#include "support/catch.h"

namespace variation_field_test {

using namespace thermal;

namespace {

constexpr float kTexel = 1.0F / 16;  // the field's grain, in correlation lengths; it repeats after 16 of them
constexpr int kTexels = 256;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kStored = 1.0 / 4096;                // quantisation step of the field's values
constexpr double kRoundingStddev = kStored / 3.4641;  // rounding error: a step / sqrt(12)
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Values on the field's own grid, where reading does not interpolate.
std::vector<double> grid_of(const VariationField& field, float footprint, float offset = 0) {
  std::vector<double> values;
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      const float value = field.sample(static_cast<float>(x) * kTexel + offset,
                                       static_cast<float>(y) * kTexel + offset, footprint);
      values.push_back(static_cast<double>(value));
    }
  }
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values) {
  const double middle = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return sum / static_cast<double>(values.size());
}

/// Mean product of values at a distance, along both axes, over a field of mean 0 and variance 1.
double correlation(const VariationField& field, int lag_texels) {
  const std::vector<double> values = grid_of(field, 0);
  const auto at = [&](int x, int y) {
    return values[static_cast<std::size_t>(y % kTexels * kTexels + x % kTexels)];
  };
  double sum = 0;
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) sum += at(x, y) * (at(x + lag_texels, y) + at(x, y + lag_texels)) / 2;
  }
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("The field has mean 0 and variance 1") {
  for (const std::uint32_t seed : {1U, 2U, 77U}) {
    const std::vector<double> values = grid_of(VariationField(seed), 0);
    // Stored values are rounded to kStored. Such errors average out with the root of their number; five times that.
    const double bound = 5 * kRoundingStddev / kTexels;
    CHECK_THAT(mean(values), WithinAbs(0, bound));
    CHECK_THAT(variance(values), WithinAbs(1, 2 * bound));
  }
}

TEST_CASE("At a correlation length, the correlation is a third") {
  // An octave of B-spline noise of lattice spacing h has the correlation of a B-spline of degree 7: 1191/2416 at h,
  // 120/2416 at 2 h, almost nothing from 3 h on. Octaves of h = 1, 1/2, 1/4 ... carry variances 1, .36, .36^2 ...
  const double octaves = 1 + .36 + std::pow(.36, 2) + std::pow(.36, 3) + std::pow(.36, 4);
  const double expected = (1191 + .36 * 120) / 2416 / octaves;  // .328
  constexpr int kFields = 24;
  std::vector<double> found;
  for (std::uint32_t seed = 1; seed <= kFields; ++seed)
    found.push_back(correlation(VariationField(seed), 16));
  // Each field has 256 cells of the coarsest octave, and its correlation scatters; the mean of 24 scatters by
  // sqrt(24) less. Five of these. Removing each field's own mean costs 1/256/.23/1.55 * .67 = .007 on top.
  const double bound = 5 * std::sqrt(variance(found) / (kFields - 1)) + 0.007;
  CHECK(bound < 0.08);
  CHECK_THAT(mean(found), WithinAbs(expected, bound));
}

TEST_CASE("A larger footprint reduces the field, and sixteen lengths remove it") {
  const VariationField field(5);
  double before = 1 + 1e-6;
  for (float footprint = kTexel; footprint < 16; footprint *= 2) {
    const double here = variance(grid_of(field, footprint));
    CAPTURE(footprint, before, here);
    CHECK(here < before);
    before = here;
  }
  // At 8 lengths four values are left, each the mean of 64 cells of the coarsest octave, which has 1/1.55 of
  // the variance: 1/64/.23/1.55 = .044 in theory, and, of three degrees of freedom, five times that at most.
  CHECK(before < 5 * 0.044);
  for (const float footprint : {16.0F, 17.0F, 1e6F, kInfinity, kNaN})
    CHECK(field.sample(3.3F, 4.4F, footprint) == 0);
}

TEST_CASE("The mean stays 0 under every footprint: a far picture is no warmer than a near one") {
  const VariationField field(5);
  int texels = kTexels;  // along each axis, in the level that a footprint is read from
  for (float footprint = kTexel; footprint < 16; footprint *= 2) {
    // Rounding of a few values leaves at most half a step; of many, five times the root of their number.
    const double bound = std::min(kStored / 2, 5 * kRoundingStddev / texels);
    CAPTURE(footprint, texels);
    CHECK_THAT(mean(grid_of(field, footprint)), WithinAbs(0, bound));
    texels /= 2;
  }
}

TEST_CASE("The field continues without a jump, below 0 and past its period") {
  const VariationField field(9);
  // Between texels the field is linear: a step of a hundredth of a texel changes it by at most a hundredth of the
  // largest difference between neighbours, plus rounding: a position near 17 is a float accurate to 1e-6, a value to
  // 4e-7.
  const std::vector<double> values = grid_of(field, 0);
  double steepest = 0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    steepest = std::max(steepest, std::abs(values[i + 1] - values[i]));
  for (const float y : {-0.51F, 0.0F, 7.77F, 15.99F}) {
    double before = static_cast<double>(field.sample(-1, y, 0));
    for (int step = 1; step < 18 * 1600; ++step) {
      const double here =
          static_cast<double>(field.sample(-1 + static_cast<float>(step) * kTexel / 100, y, 0));
      REQUIRE(std::abs(here - before) <= steepest * (0.01 + 16 * 2e-6) + 8e-7);
      before = here;
    }
  }
}

TEST_CASE("It repeats after sixteen correlation lengths, whatever the sign") {
  const VariationField field(9);
  for (const float x : {0.25F, 3.0F, 9.5F}) {  // exact in binary, so are the shifted places
    CHECK(field.sample(x, 1.5F, 0) == field.sample(x - 16, 1.5F, 0));
    CHECK(field.sample(x, 1.5F, 0) == field.sample(x + 160, 1.5F - 32, 0));
  }
}

TEST_CASE("The same seed gives the same field, another seed another") {
  const std::vector<double> values = grid_of(VariationField(3), 0);
  CHECK(grid_of(VariationField(3), 0) == values);
  const std::vector<double> others = grid_of(VariationField(4), 0);
  double product = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    product += values[i] * others[i] / static_cast<double>(values.size());
  // Of 65536 values some 256 are independent: their correlation is within five times 1/16 of 0.
  CHECK(std::abs(product) < 5.0 / 16);
}

TEST_CASE("Invalid places are at the mean") {
  const VariationField field(5);
  for (const float bad : {kNaN, kInfinity, -kInfinity, 1e5F, -1e30F}) {
    CHECK(field.sample(bad, 1, 0) == 0);
    CHECK(field.sample(1, bad, 0) == 0);
  }
  CHECK(field.sample(99'999, -99'999, 0) != 0);
}

TEST_CASE("Many places at once give the same as each alone") {
  const VariationField field(5);
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> footprint;
  for (int i = 0; i < 1000; ++i) {
    x.push_back(static_cast<float>(i) * 0.317F - 100);
    y.push_back(static_cast<float>(i) * -0.713F + 50);
    footprint.push_back(static_cast<float>(i) * 0.02F);
  }
  x[17] = kNaN;
  std::vector<float> value(x.size());
  field.sample(x, y, footprint, value);
  for (std::size_t i = 0; i < x.size(); ++i) REQUIRE(value[i] == field.sample(x[i], y[i], footprint[i]));
}

}  // namespace variation_field_test
