#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "imaging/ground/noise.h"
#include "imaging/ground/temperatures.h"
#include "imaging/heated_emission.h"
#include "support/catch.h"

namespace ground_temperatures_test {

using namespace thermal;

namespace {

constexpr std::size_t kCells = 64;
constexpr std::size_t kFineCells = 2 * kCells;

/// Bare soil and nothing else.
GroundCovers bare(std::vector<std::string> kinds = {"soil"}) {
  const std::vector<std::uint8_t> none(kFineCells * kFineCells);
  return {.cells = kFineCells,
          .kinds = std::move(kinds),
          .kind = none,
          .grass = none,
          .trodden = none,
          .ash = none,
          .border = std::vector<std::uint8_t>(none.size(), 255)};
}

/// Level ground of 64 m with open sky, whose moisture rises from west to east.
GroundMaps maps() {
  GroundMaps maps;
  maps.size_m = kCells;
  maps.cells = kCells;
  maps.sky_view.assign(kCells * kCells, 255);
  maps.height_m.assign(kCells * kCells, 10);
  maps.crown_top_m.assign(kCells * kCells, 0);
  maps.covers = bare();
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

MaterialMoment always(double temperature_k) { return between_moistures(temperature_k, temperature_k); }

GroundWindow all() { return {.width = kCells, .height = kCells}; }

/// All parts of one heat, which keep their temperatures.
GroundWarmth steady(const MaterialMoment& heat) {
  return {.first = {.parts = std::vector(1 + kLoosePartNames.size(), GroundPart{&heat}), .sunlit = {}},
          .last = {}};
}

GroundTexture ground_of(const GroundMaps& maps, const GroundWindow& window, const GroundWarmth& warmth,
                        bool rough = false) {
  return ground_temperatures(maps, ground_of_window(maps, window, rough, 3), warmth);
}

struct Sampled {
  float temperature_k = -1;
  float sky_view = 2;
};

Sampled sampled(const GroundTexture& ground, float x_m, float y_m, float footprint_m, float later_h = 0,
                std::int32_t is_ground = 1) {
  const std::uint16_t surface = 0;
  Sampled result;
  const auto bits = std::bit_cast<std::int32_t>(footprint_m);
  ground.sample({.surface = {&surface, 1},
                 .is_ground = {&is_ground, 1},
                 .x_m = {&x_m, 1},
                 .y_m = {&y_m, 1},
                 .footprint_m = {&footprint_m, 1},
                 .footprints = {static_cast<std::uint32_t>(bits), bits}},
                later_h, {&result.temperature_k, 1}, {&result.sky_view, 1});
  return result;
}

float at(const GroundTexture& ground, float x_m, float y_m, float footprint_m) {
  return sampled(ground, x_m, y_m, footprint_m).temperature_k;
}

/// The largest and the smallest of many places.
std::array<float, 2> range_of(const GroundTexture& ground) {
  std::array<float, 2> range = {1e9F, -1e9F};
  for (float y = -31; y < 31; y += 0.43F) {
    for (float x = -31; x < 31; x += 0.37F) {
      const float value_k = at(ground, x, y, 0.05F);
      range = {std::min(range[0], value_k), std::max(range[1], value_k)};
    }
  }
  return range;
}

}  // namespace

TEST_CASE(
    "A cold pool cools the lowest ground by all of it, the highest by nothing, all other by its height") {
  GroundMaps slope = maps();
  for (std::size_t i = 0; i < kCells * kCells; ++i)
    slope.height_m[i] = 900 + 0.5F * static_cast<float>(i % kCells);
  const MaterialMoment even = always(280);
  GroundWarmth warmth = steady(even);
  CHECK(at(ground_of(slope, all(), warmth), 0, 0, 0.05F) == 280);
  warmth.first.cold_pool_k = 6.3;
  const GroundTexture pool = ground_of(slope, all(), warmth);
  // 63 steps of 0.1 K; the middles of cells are half a metre from the borders.
  CHECK_THAT(at(pool, 31.5F, 0, 0.05F), WithinAbs(280, 0.03));
  CHECK_THAT(at(pool, -31.5F, 0, 0.05F), WithinAbs(273.7, 0.03));
  CHECK_THAT(at(pool, 0, 0, 0.05F), WithinAbs(276.85, 0.03));
  CHECK(at(ground_of(maps(), all(), warmth), 0, 0, 0.05F) == 280);  // level
}

TEST_CASE("Temperatures are those of the maps, in straight lines between the middles of their cells") {
  const MaterialMoment heat = by_moisture();
  const GroundTexture ground = ground_of(maps(), all(), steady(heat));
  // The middle of column 10 is at -32 + 10.5 m; its moisture is 40 of 255, of column 11 it is 44. Steps of 1/512 K, and
  // rounding.
  const auto k_at = [](double column) { return 270 + 10 * 4 * column / 255; };
  CHECK_THAT(at(ground, -21.25F, 3, 0.05F), WithinAbs(k_at(10.25), 0.0011));
  CHECK_THAT(at(ground, -21.0F, 3, 0.05F), WithinAbs(k_at(10.5), 0.0021));
  // Beyond the border what is there: the last column's.
  CHECK_THAT(at(ground, 500, 3, 0.05F), WithinAbs(k_at(63), 0.0011));
  CHECK_THAT(at(ground, 0, 0, 64), WithinAbs(k_at(31.5), 0.1));
}

TEST_CASE("Parts are mixed by their shares, and what they leave is the kind of the cell") {
  GroundMaps mixed = maps();
  mixed.covers = bare({"soil", "road"});
  for (std::size_t i = 0; i < kFineCells * kFineCells; ++i) {
    const bool is_road = i % kFineCells >= kFineCells / 2;
    mixed.covers.kind[i] = is_road ? 1 : 0;
    if (!is_road) mixed.covers.grass[i] = 102;  // 0.4
    mixed.covers.trodden[i] = 51;               // 0.2
  }
  const MaterialMoment soil = always(270);
  const MaterialMoment road = always(280);
  const MaterialMoment grass = always(260);
  const MaterialMoment trodden = always(275);
  const MaterialMoment none = always(250);
  GroundWarmth warmth = steady(none);
  // The order of ground_part_names(): kinds, grass, litter, trodden, ash, rock.
  warmth.first.parts = {{&soil}, {&road}, {&grass}, {&none}, {&trodden}, {&none}, {&soil}};
  const GroundTexture ground = ground_of(mixed, all(), warmth);
  // Of a hundredth that is rock, here as warm as soil; then a fifth of the rest is trodden. Shares are bytes.
  const double left = 0.99 * 0.8;
  CHECK_THAT(at(ground, -16, 0, 0.05F),
             WithinAbs(0.01 * 270 + 0.99 * 0.2 * 275 + left * (0.4 * 260 + 0.6 * 270), 0.08));
  CHECK_THAT(at(ground, 16, 0, 0.05F), WithinAbs(0.01 * 270 + 0.99 * 0.2 * 275 + left * 280, 0.08));
  // A part that looks warmer, by the sky it sees.
  warmth.first.parts[2].shift = {.without_sky_k = 1, .by_sky_view_k = 2};
  CHECK_THAT(at(ground_of(mixed, all(), warmth), -16, 0, 0.05F) - at(ground, -16, 0, 0.05F),
             WithinAbs(left * 0.4 * 3, 0.02));
}

TEST_CASE("Grass is uneven from tussock to tussock, keeps its mean, and never leaves what parts have") {
  GroundMaps meadow = maps();
  meadow.moisture.assign(kCells * kCells, 0);
  meadow.covers.grass.assign(kFineCells * kFineCells, 128);
  const MaterialMoment soil = always(270);
  const MaterialMoment grass = always(274);
  GroundWarmth warmth = steady(soil);
  warmth.first.parts[1] = {&grass};
  const auto [even_low, even_high] = range_of(ground_of(meadow, all(), warmth));
  CHECK(even_high - even_low < 0.01F);
  const GroundTexture rough = ground_of(meadow, all(), warmth, true);
  const auto [low, high] = range_of(rough);
  CHECK(low >= 270 - 0.01F);
  CHECK(high <= 274 + 0.01F);
  CHECK(high - low > 2);
  // Of (64 m / 6 m)^2 = 114 independent patches whose deviation is at most 1.6 K, five standard deviations.
  CHECK_THAT(at(rough, 0, 0, 64), WithinAbs(even_low, 5 * 1.6 / std::sqrt(114.0)));
}

TEST_CASE("Litter lies below crowns, and no grass grows where the ground burnt") {
  GroundMaps wood = maps();
  wood.covers.grass.assign(kFineCells * kFineCells, 200);
  wood.crown_top_m[20 * kCells + 10] = 4;
  for (const std::size_t cell : {0U, 1U, 128U, 129U}) wood.covers.ash[cell] = 255;
  const CutWindow window = cut_window(wood, all());
  REQUIRE(window.cuts == 4);
  const auto mixes = ground_mixture(wood, window, true, 3);
  // A cell of the maps has 8 x 8 cells.
  std::size_t litter = 0;
  for (std::size_t i = 0; i < 64; ++i)
    litter += mixes[(8 * 20 + i / 8) * window.cells.width + 8 * 10 + i % 8].share[1];
  CHECK(litter / 64 > 25);
  CHECK(mixes[8 * 20 * window.cells.width + 8 * 10 + 8].share[1] == 0);
  CHECK(mixes[0].share[0] == 0);
  std::size_t grassy = 0;
  for (const GroundMix& mix : mixes) {
    int sum = 0;
    for (const std::uint8_t share : mix.share) sum += share;
    CHECK(sum <= 255);
    grassy += mix.share[0] > 0 ? 1U : 0U;
  }
  CHECK(grassy > mixes.size() / 2);
}

TEST_CASE("Litter ends smoothly where crowns do, not with the cells of the maps") {
  GroundMaps wood = maps();
  // Crowns west of the middle of the place.
  for (std::size_t i = 0; i < kCells * kCells; ++i) wood.crown_top_m[i] = i % kCells < 32 ? 4 : 0;
  const CutWindow window = cut_window(wood, all());
  const auto mixes = ground_mixture(wood, window, false, 3);
  const auto litter = [&](std::size_t column) { return mixes[100 * window.cells.width + column].share[1]; };
  const std::size_t rim = window.cells.width / 2;
  CHECK(litter(rim - 8) > 120);
  CHECK(litter(rim + 8) == 0);
  for (std::size_t column = rim - 8; column < rim + 8; ++column) {
    CHECK(litter(column) >= litter(column + 1));
    CHECK(litter(column) - litter(column + 1) <= 36);  // a quarter of what lies below crowns, over 12 cm
  }
}

TEST_CASE("As many specks are of litter as of stones, where soil is bare") {
  const GroundMaps bare_soil = maps();
  const auto mixes = ground_mixture(bare_soil, cut_window(bare_soil, all()), true, 3);
  std::array<std::size_t, 2> specks{};
  for (const GroundMix& mix : mixes) {
    specks[0] += mix.share[1] > 0 ? 1U : 0U;
    specks[1] += mix.share[4] > 0 ? 1U : 0U;
  }
  // One cell in forty each. Of (64 m / 0.25 m)^2 = 65,536 points of the lattice, 1600 are beyond: five standard deviations.
  const double each = static_cast<double>(mixes.size()) / 40;
  for (const std::size_t count : specks) CHECK_THAT(static_cast<double>(count) / each, WithinAbs(1, 0.35));
}

TEST_CASE("Each part is uneven by its variation, as finely as a quarter of a metre, and keeps its mean") {
  GroundMaps yard = maps();
  yard.covers = bare({"soil", "yard"});
  yard.covers.kind.assign(kFineCells * kFineCells, 1);
  const MaterialMoment heat = always(270);
  GroundWarmth warmth = steady(heat);
  warmth.first.parts.emplace_back(GroundPart{&heat});
  const auto [even_low, even_high] = range_of(ground_of(yard, all(), warmth, true));
  CHECK(even_high - even_low < 0.01F);
  warmth.first.parts[1].variation_k = 0.9;
  const GroundTexture rough = ground_of(yard, all(), warmth, true);
  double sum = 0;
  double squares = 0;
  double differences = 0;
  int count = 0;
  for (float y = -31; y < 31; y += 0.43F) {
    for (float x = -31; x < 31; x += 0.37F, ++count) {
      const double off_k = static_cast<double>(at(rough, x, y, 0.05F)) - 270;
      sum += off_k;
      squares += off_k * off_k;
      differences += std::pow(off_k - static_cast<double>(at(rough, x + 0.5F, y, 0.05F)) + 270, 2);
    }
  }
  // Half of 0.9 K. Of (64 m / 2 m)^2 = 1024 patches: five standard deviations of the mean and of the spread.
  CHECK_THAT(sum / count, WithinAbs(0, 5 * 0.45 / 32));
  const double spread_k = std::sqrt(squares / count);
  CHECK_THAT(spread_k, WithinAbs(0.45, 5 * 0.45 / 32 / std::sqrt(2)));
  CHECK(std::sqrt(differences / count) > 0.5 * spread_k);  // half a metre away
  CHECK(ground_of_window(yard, all(), false, 3).fabric.empty());
}

TEST_CASE("Water has its depth in straight lines between cells, and land has none") {
  GroundMaps lake = maps();
  CHECK(WaterDepths(lake, all()).at(0, 0) == 0);
  for (std::size_t i = 0; i < kCells * kCells; ++i)
    lake.water_m.push_back(i % kCells < 32 ? 0.1F * static_cast<float>(32 - i % kCells) : 0.0F);
  const WaterDepths depths(lake, all());
  CHECK_THAT(depths.at(-10, 3), WithinAbs(1.05, 1e-5));  // between columns 21 and 22
  CHECK_THAT(depths.at(0, 3), WithinAbs(0.05, 1e-5));
  CHECK(depths.at(1, 3) == 0);
  CHECK(depths.at(std::numeric_limits<float>::quiet_NaN(), 3) == 0);
  const WaterDepths part(lake, {.first_x = 20, .first_y = 30, .width = 12, .height = 9});
  CHECK_THAT(part.at(-10, 2), WithinAbs(1.05, 1e-5));
}

TEST_CASE("Pixels that are not ground or have no place keep the temperature they had") {
  const MaterialMoment heat = by_moisture();
  const GroundTexture ground = ground_of(maps(), all(), steady(heat));
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  CHECK(at(ground, kNaN, 0, 0.1F) == -1);
  CHECK(at(ground, 0, 0, kNaN) == -1);
  CHECK(at(ground, 0, 0, -1) == -1);
  CHECK(sampled(ground, 0, 0, 0.1F, 0, 0).temperature_k == -1);
}

TEST_CASE("The top of crowns is that of the cell") {
  GroundMaps wood = maps();
  wood.crown_top_m[5 * kCells + 7] = 4;
  const CrownTops tops(wood, all());
  CHECK(tops.at(-32 + 7.5F, -32 + 5.5F) == 14);
  CHECK(tops.at(0, 0) == 10);
  CHECK(tops.at(std::numeric_limits<float>::quiet_NaN(), 0) == 10);
}

TEST_CASE("The sky view of ground is that of its cells, and of other surfaces what it was") {
  GroundMaps shaded = maps();
  for (std::size_t i = 0; i < kCells * kCells; ++i)
    shaded.sky_view[i] = static_cast<std::uint8_t>(3 * (i % kCells));
  const MaterialMoment heat = by_moisture();
  const GroundTexture ground = ground_of(shaded, all(), steady(heat));
  // A quarter of the way from the middle of column 10 to that of column 11, and halfway; steps of 1/255.
  CHECK_THAT(sampled(ground, -21.25F, 3, 0.02F).sky_view, WithinAbs(31 / 255.0, 0.0001));
  CHECK_THAT(sampled(ground, -21.0F, 3, 0.02F).sky_view, WithinAbs(31.5 / 255.0, 0.0001));
  CHECK(sampled(ground, -21.5F, 3, 0.02F, 0, 0).sky_view == -1);
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
  warmth.last.parts.assign(warmth.first.parts.size(), {&last});
  warmth.hours = 0.5;
  const GroundTexture ground = ground_of(maps(), all(), warmth);
  const float x_m = GENERATE(-31.75F, -21.25F, 20.25F);
  const double moisture = std::max(0.0, static_cast<double>(x_m) + 31.5) * 4 / 255;
  const double now_k = static_cast<double>(at(ground, x_m, 3, 0.05F));
  for (const float later_h : {-0.25F, 0.1F, 0.25F}) {
    // 1/127 of the fastest warming, 6 K/h, and rounding.
    const double expected_k = now_k + (2 + 4 * moisture) * static_cast<double>(later_h);
    CHECK_THAT(sampled(ground, x_m, 3, 0.05F, later_h).temperature_k,
               WithinAbs(expected_k, 0.25 * 6 / 127 / 2 + 1e-4));
  }
}

TEST_CASE("A window shows what the whole place shows there, noise included") {
  const MaterialMoment heat = by_moisture();
  const GroundTexture whole = ground_of(maps(), all(), steady(heat), true);
  const GroundTexture part =
      ground_of(maps(), {.first_x = 20, .first_y = 30, .width = 12, .height = 9}, steady(heat), true);
  for (float x = -10; x < -2; x += 0.7F)  // two cells of the covers from its border
    CHECK_THAT(at(part, x, 2.4F, 0.1F), WithinAbs(at(whole, x, 2.4F, 0.1F), 0.003));
}

TEST_CASE("Noise of the ground has mean 0 and variance 1, and does not repeat itself") {
  const GroundWindow window = {.width = 1024, .height = 1024};
  const std::vector<float> noise = ground_noise(window, {.length_cells = 8}, 7, 1);
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
  CHECK(ground_noise({.width = 4, .height = 4}, {.length_cells = 1}, 7, 1) == std::vector<float>(16, 0.0F));
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
