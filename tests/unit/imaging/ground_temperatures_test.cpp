#include "imaging/ground_temperatures.h"

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "imaging/ground_noise.h"
#include "imaging/ground_window.h"
#include "imaging/heated_emission.h"
#include "support/catch.h"

namespace ground_temperatures_test {

using namespace thermal;

namespace {

constexpr std::size_t kCells = 64;

/// Level ground of 64 m with open sky, whose moisture rises from west to east.
GroundMaps maps() {
  GroundMaps maps;
  maps.size_m = kCells;
  maps.cells = kCells;
  maps.sky_view.assign(kCells * kCells, 255);
  maps.height_m.assign(kCells * kCells, 10);
  maps.crown_top_m.assign(kCells * kCells, 0);
  maps.crown_top_m[5 * kCells + 7] = 4;
  maps.grass.assign(kCells * kCells, 0);
  for (std::size_t i = 0; i < kCells * kCells; ++i)
    maps.moisture.push_back(static_cast<std::uint8_t>(4 * (i % kCells)));
  return maps;
}

MaterialMoment between_moistures(double dry_k, double wet_k) {
  return {
      {.sky_view = {1}, .sunlit = {1}, .moisture = {0, 1}}, {dry_k, wet_k}, {Orientation(), Orientation()}};
}

/// 270 K where it is dry, 280 K where it is wet.
MaterialMoment by_moisture() { return between_moistures(270, 280); }

GroundWindow all() { return {.width = kCells, .height = kCells}; }

/// Of one cover that keeps its temperatures.
GroundWarmth steady(const MaterialMoment& heat) {
  return {.first = {.covers = {&heat}, .sunlit = {}}, .last = {}};
}

GroundTemperatures ground_of(const GroundMaps& maps, const GroundWindow& window, const GroundWarmth& warmth,
                             const CoverVariation& variation = {}) {
  return {maps, window, {&variation, 1}, warmth, 3};
}

struct Sampled {
  float temperature_k = -1;
  float sky_view = 2;
};

Sampled sampled(const GroundTemperatures& ground, float x_m, float y_m, float footprint_m, float later_h = 0,
                std::int32_t cover = 0) {
  const std::uint16_t surface = 0;
  Sampled result;
  const auto bits = std::bit_cast<std::int32_t>(footprint_m);
  ground.texture().sample({.surface = {&surface, 1},
                           .cover_of_surface = {&cover, 1},
                           .x_m = {&x_m, 1},
                           .y_m = {&y_m, 1},
                           .footprint_m = {&footprint_m, 1},
                           .footprints = {static_cast<std::uint32_t>(bits), bits}},
                          later_h, {&result.temperature_k, 1}, {&result.sky_view, 1});
  return result;
}

float at(const GroundTemperatures& ground, float x_m, float y_m, float footprint_m) {
  return sampled(ground, x_m, y_m, footprint_m).temperature_k;
}

}  // namespace

TEST_CASE("Temperatures are those of the cells, in straight lines between their middles") {
  const MaterialMoment heat = by_moisture();
  const GroundTemperatures ground = ground_of(maps(), all(), steady(heat));
  // The middle of column 10 is at -32 + 10.5 m; its moisture is 40 of 255. Steps of 1/512 K, and rounding.
  const double k10 = 270 + 10 * 40 / 255.0;
  const double k11 = 270 + 10 * 44 / 255.0;
  CHECK_THAT(at(ground, -21.5F, 3, 0.05F), WithinAbs(k10, 0.0011));
  CHECK_THAT(at(ground, -21.0F, 3, 0.05F), WithinAbs(0.5 * (k10 + k11), 0.0021));
  // Far away the mean of the place, at its border the border's.
  CHECK_THAT(at(ground, 500, 3, 0.05F), WithinAbs(270 + 10 * 252 / 255.0, 0.0011));
  CHECK_THAT(at(ground, 0, 0, 64), WithinAbs(270 + 10 * 126 / 255.0, 0.1));
}

TEST_CASE("Pixels without a cover or a place keep the temperature they had") {
  const MaterialMoment heat = by_moisture();
  const GroundTemperatures ground = ground_of(maps(), all(), steady(heat));
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  CHECK(at(ground, kNaN, 0, 0.1F) == -1);
  CHECK(at(ground, 0, 0, kNaN) == -1);
  CHECK(at(ground, 0, 0, -1) == -1);
  CHECK(ground.crown_top_m(-32 + 7.5F, -32 + 5.5F) == 14);
  CHECK(ground.crown_top_m(0, 0) == 10);
}

TEST_CASE("The sky view of ground is that of its cells, and of other surfaces what it was") {
  GroundMaps shaded = maps();
  for (std::size_t i = 0; i < kCells * kCells; ++i)
    shaded.sky_view[i] = static_cast<std::uint8_t>(3 * (i % kCells));
  const MaterialMoment heat = by_moisture();
  const GroundTemperatures ground = ground_of(shaded, all(), steady(heat));
  // In the middle of column 10, and halfway to column 11.
  CHECK_THAT(sampled(ground, -21.5F, 3, 0.02F).sky_view, WithinAbs(30 / 255.0, 0.0001));
  CHECK_THAT(sampled(ground, -21.0F, 3, 0.02F).sky_view, WithinAbs(31.5 / 255.0, 0.0001));
  CHECK(sampled(ground, -21.5F, 3, 0.02F, 0, -1).sky_view == -1);
  CHECK(sampled(ground, -21.5F, 3, -1).sky_view == -1);
  Row row;
  row.ground_sky_view = {0.25F, -1};
  row.sky_view = {1, 0.5F};
  mapped_sky_view()(row);
  CHECK(row.sky_view == std::vector<float>{0.25F, 0.5F});
  // Temperatures are what they are under an open sky: this material does not ask for it.
  CHECK(at(ground, -21.5F, 3, 0.05F) == at(ground_of(maps(), all(), steady(heat)), -21.5F, 3, 0.05F));
}

TEST_CASE("Ground warms in a straight line through the clip, each place at its own pace") {
  // From the first to the last frame, half an hour, dry ground warms by 1 K and wet ground by 3 K.
  const MaterialMoment first = between_moistures(269.5, 278.5);
  const MaterialMoment last = between_moistures(270.5, 281.5);
  GroundWarmth warmth = steady(first);
  warmth.last.covers = {&last};
  warmth.hours = 0.5;
  const GroundTemperatures ground = ground_of(maps(), all(), warmth);
  const float x_m = GENERATE(-31.5F, -21.5F, 20.5F);
  const double moisture = std::floor(static_cast<double>(x_m) + 32) * 4 / 255;
  const double now_k = static_cast<double>(at(ground, x_m, 3, 0.05F));
  for (const float later_h : {-0.25F, 0.1F, 0.25F}) {
    // 1/127 of the fastest warming, 6 K/h, and rounding.
    const double expected_k = now_k + (2 + 4 * moisture) * static_cast<double>(later_h);
    CHECK_THAT(sampled(ground, x_m, 3, 0.05F, later_h).temperature_k,
               WithinAbs(expected_k, 0.25 * 6 / 127 / 2 + 1e-4));
  }
}

TEST_CASE("Ground without a cover has neither temperature nor sky view") {
  const GroundTemperatures ground(maps(), all(), {}, {}, 1);
  CHECK(sampled(ground, 0, 0, 0.1F).temperature_k == -1);
  CHECK(sampled(ground, 0, 0, 0.1F).sky_view == -1);
}

TEST_CASE("A window shows what the whole place shows there, noise included") {
  const MaterialMoment heat = by_moisture();
  const CoverVariation variation = {.stddev_k = 1, .correlation_length_m = 8};
  const GroundTemperatures whole = ground_of(maps(), all(), steady(heat), variation);
  const GroundTemperatures part =
      ground_of(maps(), {.first_x = 20, .first_y = 30, .width = 12, .height = 9}, steady(heat), variation);
  for (float x = -11; x < -1; x += 0.7F)
    CHECK_THAT(at(part, x, 2.4F, 0.1F), WithinAbs(at(whole, x, 2.4F, 0.1F), 0.003));
}

TEST_CASE("Noise of the ground has mean 0 and variance 1, and does not repeat itself") {
  const GroundWindow window = {.width = 1024, .height = 1024};
  const std::vector<float> noise = ground_noise(window, 8, 7, 1);
  double sum = 0;
  double squares = 0;
  double shifted = 0;
  for (std::size_t i = 0; i < noise.size(); ++i) {
    sum += static_cast<double>(noise[i]);
    squares += static_cast<double>(noise[i] * noise[i]);
    if (i % 1024 < 1024 - 128) shifted += static_cast<double>(noise[i] * noise[i + 128]);
  }
  const auto count = static_cast<double>(noise.size());
  // About (1024 / 8)^2 = 16,384 independent values: five standard deviations of mean and variance, for values that are
  // nearly normal, and of a correlation at 16 lengths, where the field used to repeat.
  CHECK_THAT(sum / count, WithinAbs(0, 5.0 / 128 * 1.5));
  CHECK_THAT(squares / count, WithinAbs(1, 5.0 / 128 * std::sqrt(2) * 1.5));
  CHECK_THAT(shifted / count, WithinAbs(0, 5.0 / 128 * 1.5));
  CHECK(ground_noise({.width = 4, .height = 4}, 1, 7, 1) == std::vector<float>(16, 0.0F));
}

TEST_CASE("A window holds what a camera sees, and everything where it sees the horizon") {
  Manifest manifest;
  manifest.camera = {640, 512, 1000, 1000, 320, 256};
  manifest.frames.resize(1);
  // Straight down from 30 m above the ground, over (4, -6): half of 640 px is 0.32 of the height.
  manifest.frames[0].camera_to_world = {1, 0, 0, 4, 0, -1, 0, -6, 0, 0, -1, 40, 0, 0, 0, 1};
  const GroundWindow window = window_of(maps(), manifest);
  CHECK(window.first_x <= 32 + 4 - 9);
  CHECK(window.first_x + window.width >= 32 + 4 + 10);
  CHECK(window.width < 40);
  CHECK(window.first_y <= 32 - 6 - 7);
  manifest.frames[0].camera_to_world = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 40, 0, 0, 0, 1};
  CHECK(window_of(maps(), manifest) == all());
  manifest.frames[0].camera_to_world.reset();
  CHECK(window_of(maps(), manifest) == all());
}

}  // namespace ground_temperatures_test
