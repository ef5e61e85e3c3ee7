#include "sensor/pattern_noise.h"

#include <cmath>
#include <set>
#include <vector>

#include "base/rng.h"
#include "support/catch.h"

namespace pattern_noise_test {

using namespace thermal;

namespace {

constexpr int kWidth = 70;
constexpr int kHeight = 48;

Plane<float> picture_of(const PatternNoise& noise, int width_px = kWidth, int height_px = kHeight) {
  Plane<float> picture(width_px, height_px);
  noise.add(0, 1, picture.pixels());
  return picture;
}

Plane<float> frame_of(PatternNoise& noise, std::uint32_t frame, const ShutterState& shutter = {},
                      double time_s = 0) {
  noise.begin_frame(frame, time_s, shutter);
  return picture_of(noise);
}

PatternNoise noise_of(const NoiseParameters& parameters, std::uint32_t seed = 1, const char* clip = "a") {
  return {parameters, seed, clip, kWidth, kHeight};
}

/// Whether every row is constant.
bool constant_rows(const Plane<float>& picture) {
  for (int y = 0; y < picture.height_px(); ++y) {
    for (const float value : picture.row(y)) {
      if (value != picture.at(0, y)) return false;
    }
  }
  return true;
}

/// Whether every row equals the first.
bool constant_columns(const Plane<float>& picture) {
  for (int y = 0; y < picture.height_px(); ++y) {
    for (int x = 0; x < picture.width_px(); ++x) {
      if (picture.at(x, y) != picture.at(x, 0)) return false;
    }
  }
  return true;
}

/// A component, the axis along which it is constant, and whether it is fixed between two closings of the shutter.
struct Component {
  NoiseParameters parameters;
  bool rows_alike;  // all columns equal: a row is constant
  bool columns_alike;
  bool still;
};

}  // namespace

TEST_CASE("Every component is shared as its name says") {
  const auto component = GENERATE(Component{{.fixed_pattern_ratio = 1}, false, false, true},
                                  Component{{.row_ratio = 1}, true, false, true},
                                  Component{{.column_ratio = 1}, false, true, true},
                                  Component{{.temporal_row_ratio = 1}, true, false, false},
                                  Component{{.temporal_column_ratio = 1}, false, true, false},
                                  Component{{.frame_ratio = 1}, true, true, false});
  PatternNoise noise = noise_of(component.parameters);
  const Plane<float> first = frame_of(noise, 0);
  CHECK(constant_rows(first) == component.rows_alike);
  CHECK(constant_columns(first) == component.columns_alike);
  const Plane<float> second = frame_of(noise, 1);
  CHECK((second == first) == component.still);
  CHECK((frame_of(noise, 2, {.event = 1}) == second) == false);
}

TEST_CASE("No two components use the same random numbers") {
  const std::vector<NoiseParameters> alone = {
      {.fixed_pattern_ratio = 1},   {.row_ratio = 1},   {.column_ratio = 1}, {.temporal_row_ratio = 1},
      {.temporal_column_ratio = 1}, {.frame_ratio = 1}, {.drift_ratio = 1}};
  std::set<float> first_numbers;
  for (const NoiseParameters& parameters : alone) {
    PatternNoise noise = noise_of(parameters);
    first_numbers.insert(frame_of(noise, 3, {.event = 3, .since_intervals = 1}).at(0, 0));
  }
  CHECK(first_numbers.size() == alone.size());
}

TEST_CASE("Without ratios there is no pattern noise") {
  PatternNoise noise = noise_of({});
  CHECK(frame_of(noise, 0, {.event = 3, .since_intervals = 1}, 5) == Plane<float>(kWidth, kHeight));
}

TEST_CASE("Components add up and scale") {
  const NoiseParameters both = {.column_ratio = 2, .frame_ratio = 0.5};
  PatternNoise sum = noise_of(both);
  PatternNoise columns = noise_of({.column_ratio = 1});
  PatternNoise frame = noise_of({.frame_ratio = 1});
  const Plane<float> all = frame_of(sum, 4);
  const Plane<float> column = frame_of(columns, 4);
  const Plane<float> whole = frame_of(frame, 4);
  Plane<float> scaled(kWidth, kHeight);
  sum.add(0, 3, scaled.pixels());
  for (std::size_t i = 0; i < all.size(); ++i) {
    // Values to 10, each rounded to 6e-7 at most, a few times.
    REQUIRE(std::abs(all.pixels()[i] - (2 * column.pixels()[i] + 0.5F * whole.pixels()[i])) < 3e-6F);
    REQUIRE(std::abs(scaled.pixels()[i] - 3 * all.pixels()[i]) < 1e-5F);
  }
}

TEST_CASE("The pattern that drifts has grown to its ratio one interval after the shutter") {
  PatternNoise noise = noise_of({.drift_ratio = 0.8});
  const Plane<float> grown = frame_of(noise, 0, {.event = 2, .since_intervals = 1});
  CHECK(frame_of(noise, 1, {.event = 2, .since_intervals = 0}) == Plane<float>(kWidth, kHeight));
  const Plane<float> quarter = frame_of(noise, 2, {.event = 2, .since_intervals = 0.25});
  PatternNoise unit = noise_of({.drift_ratio = 1});
  const Plane<float> of_one = frame_of(unit, 0, {.event = 2, .since_intervals = 1});
  for (std::size_t i = 0; i < grown.size(); ++i) {
    REQUIRE(std::abs(quarter.pixels()[i] - (0.5F / 2 + 0.25F / 2) * grown.pixels()[i]) < 1e-6F);
    REQUIRE(std::abs(grown.pixels()[i] - 0.8F * of_one.pixels()[i]) < 1e-6F);
  }
  CHECK_FALSE(frame_of(noise, 3, {.event = 3, .since_intervals = 1}) == grown);  // begins anew
}

TEST_CASE("Bands have the given period, strength and speed") {
  PatternNoise noise = noise_of({.banding_ratio = 0.7, .banding_period_px = 16, .banding_hz = 0.5});
  const Plane<float> first = frame_of(noise, 0);
  CHECK(constant_rows(first));
  double squares = 0;
  for (int y = 0; y < kHeight; ++y) squares += std::pow(static_cast<double>(first.at(0, y)), 2) / kHeight;
  CHECK_THAT(std::sqrt(squares), WithinRel(0.7, 1e-6));  // three whole periods
  const Plane<float> half_a_second = frame_of(noise, 1, {}, 0.5);
  const Plane<float> two_seconds = frame_of(noise, 2, {}, 2);
  for (int y = 0; y < kHeight; ++y) {
    // A quarter of a turn is 4 px. Sines of numbers below 40, at 0.7 sqrt 2, rounded to single precision.
    if (y + 4 < kHeight) REQUIRE_THAT(half_a_second.at(0, y) - first.at(0, y + 4), WithinAbs(0, 3e-7));
    if (y + 16 < kHeight) REQUIRE_THAT(first.at(0, y) - first.at(0, y + 16), WithinAbs(0, 3e-7));
    REQUIRE_THAT(two_seconds.at(0, y) - first.at(0, y), WithinAbs(0, 3e-7));
  }
}

TEST_CASE("Pattern noise is the same in one piece or in many, for any size of picture") {
  const NoiseParameters parameters = {.fixed_pattern_ratio = 1,
                                      .row_ratio = 1,
                                      .column_ratio = 1,
                                      .temporal_row_ratio = 1,
                                      .temporal_column_ratio = 1,
                                      .frame_ratio = 1,
                                      .drift_ratio = 1,
                                      .banding_ratio = 1};
  const auto [width_px, height_px] =
      GENERATE(table<int, int>({{1, 1}, {1, 300}, {300, 1}, {67, 11}, {257, 3}}));
  PatternNoise noise(parameters, 1, "a", width_px, height_px);
  noise.begin_frame(0, 0, {.event = 1, .since_intervals = 0.3});
  const Plane<float> whole = picture_of(noise, width_px, height_px);
  Plane<float> pieces(width_px, height_px);
  for (std::size_t first = 0; first < pieces.size(); first += 64) {
    const std::size_t count = std::min<std::size_t>(64, pieces.size() - first);
    noise.add(first, 1, pieces.pixels().subspan(first, count));
  }
  CHECK(pieces == whole);
  for (const float value : whole.pixels()) REQUIRE(std::isfinite(value));
}

TEST_CASE("Pattern noise is a function of seed, clip, frame and shutter") {
  const NoiseParameters parameters = {.fixed_pattern_ratio = 1, .temporal_row_ratio = 1};
  PatternNoise noise = noise_of(parameters);
  (void)frame_of(noise, 0, {.event = 1});
  const Plane<float> frame = frame_of(noise, 5, {.event = 2});
  PatternNoise again = noise_of(parameters);
  CHECK(frame_of(again, 5, {.event = 2}) == frame);  // does not depend on earlier frames
  PatternNoise other_seed = noise_of(parameters, 2);
  PatternNoise other_clip = noise_of(parameters, 1, "b");
  CHECK_FALSE(frame_of(other_seed, 5, {.event = 2}) == frame);
  CHECK_FALSE(frame_of(other_clip, 5, {.event = 2}) == frame);
}

}  // namespace pattern_noise_test
