#include "imaging/ground_temperatures.h"

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

/// 270 K where it is dry, 280 K where it is wet.
MaterialMoment by_moisture() {
  return {{.sky_view = {1}, .sunlit = {1}, .moisture = {0, 1}}, {270, 280}, {Orientation(), Orientation()}};
}

GroundWindow all() { return {.width = kCells, .height = kCells}; }

float at(const GroundTemperatures& ground, float x_m, float y_m, float footprint_m) {
  const std::uint16_t surface = 0;
  const std::int32_t cover = 0;
  float temperature_k = -1;
  ground.sample({.surface = {&surface, 1},
                 .cover_of_surface = {&cover, 1},
                 .x_m = {&x_m, 1},
                 .y_m = {&y_m, 1},
                 .footprint_m = {&footprint_m, 1}},
                {&temperature_k, 1});
  return temperature_k;
}

}  // namespace

TEST_CASE("Temperatures are those of the cells, in straight lines between their middles") {
  const MaterialMoment heat = by_moisture();
  const GroundTemperatures::Cover cover = {.heat = &heat};
  const GroundTemperatures ground(maps(), all(), {}, 0, {&cover, 1}, 1);
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
  const GroundTemperatures::Cover cover = {.heat = &heat};
  const GroundTemperatures ground(maps(), all(), {}, 0, {&cover, 1}, 1);
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
  const GroundTemperatures::Cover cover = {.heat = &heat};
  const GroundTemperatures ground(shaded, all(), {}, 0, {&cover, 1}, 1);
  // One pixel on ground in the middle of column 10, one halfway to column 11, one on a body.
  const std::vector<HeatedSurface> surfaces = {
      {}, {.kind = HeatedSurface::Kind::cover, .cover = 0}, {.kind = HeatedSurface::Kind::oriented}};
  const std::vector<std::uint16_t> surface = {1, 1, 2};
  Row row;
  row.surface = surface;
  row.metres = {std::vector<float>{-21.5F, -21.0F, -21.5F}, {3, 3, 3}, {0.02F, 0.02F, 0.02F}};
  row.sky_view = {1, 1, 1};
  mapped_sky_view(surfaces, ground)(row);
  // Steps of 1/512, and rounding.
  CHECK_THAT(row.sky_view[0], WithinAbs(30 / 255.0, 0.0011));
  CHECK_THAT(row.sky_view[1], WithinAbs(31.5 / 255.0, 0.0011));
  CHECK(row.sky_view[2] == 1);
  // Temperatures are what they are under an open sky: this material does not ask for it.
  CHECK(at(ground, -21.5F, 3, 0.05F) ==
        at(GroundTemperatures(maps(), all(), {}, 0, {&cover, 1}, 1), -21.5F, 3, 0.05F));
}

TEST_CASE("A window shows what the whole place shows there, noise included") {
  const MaterialMoment heat = by_moisture();
  const GroundTemperatures::Cover cover = {.heat = &heat, .stddev_k = 1, .correlation_length_m = 8};
  const GroundTemperatures whole(maps(), all(), {}, 0, {&cover, 1}, 3);
  const GroundTemperatures part(maps(), {.first_x = 20, .first_y = 30, .width = 12, .height = 9}, {}, 0,
                                {&cover, 1}, 3);
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
