#include "sensor/local_tone.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/parallel.h"
#include "sensor/agc.h"
#include "support/agc_reference.h"
#include "support/catch.h"

namespace local_tone_test {

using namespace thermal;

namespace {

using Counts = Plane<std::uint16_t>;
using Levels = Plane<std::uint8_t>;

constexpr int kBinCounts = 4;
constexpr double kCountsPerNetd = 5;

/// A ground that warms from left to right by `rise` counts, under noise of +- `noise`.
Counts ground(int width_px, int height_px, double rise, int noise, unsigned seed = 1) {
  std::mt19937 random(seed);
  Counts counts(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const int here = static_cast<int>(random() % static_cast<unsigned>(2 * noise + 1)) - noise;
      counts.at(x, y) = static_cast<std::uint16_t>(28000 + static_cast<int>(rise * x / width_px) + here);
    }
  return counts;
}

Agc clahe(AgcParameters parameters) {
  parameters.mode = AgcMode::clahe;
  AgcScene scene;
  scene.netd_k = 0.05;
  return {parameters, scene};
}

Levels shown(Agc& agc, const Counts& counts) {
  (void)agc.next(counts);
  Levels levels;
  agc.show(counts, levels);
  return levels;
}

Levels shown(const AgcParameters& parameters, const Counts& counts) {
  Agc agc = clahe(parameters);
  return shown(agc, counts);
}

}  // namespace

TEST_CASE("clahe with one tile and no limits is plain equalisation") {
  const Counts counts = ground(80, 60, 300, 30);
  const AgcParameters parameters = {.tail_percent = 0,
                                    .plateau_percent = 100,
                                    .max_gain_dn_per_netd = 255,
                                    .clip_limit = 1000,
                                    .tiles_across = 1,
                                    .tiles_down = 1};
  const Levels levels = shown(parameters, counts);
  const std::vector<double> exact =
      agc_reference::plateau_levels(parameters, kCountsPerNetd, kBinCounts, counts);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double level = agc_reference::level_between(exact, kBinCounts, counts.pixels()[i]);
    REQUIRE(std::abs(levels.pixels()[i] - level) < 0.51);
  }
}

TEST_CASE("A tile's curve is no steeper than its clip limit, and what was spread, times a straight line") {
  const double clip_limit = GENERATE(1.0, 3.0);
  const Counts counts = ground(80, 60, 600, 200);
  Agc agc = clahe({.tail_percent = 0,
                   .max_gain_dn_per_netd = 255,
                   .clip_limit = clip_limit,
                   .tiles_across = 1,
                   .tiles_down = 1});
  (void)agc.next(counts);
  const auto [low, high] = std::ranges::minmax(counts.pixels());
  const int bins = high / kBinCounts - low / kBinCounts + 1;
  Counts line(1000, 1);
  for (int x = 0; x < 1000; ++x) line.at(x, 0) = static_cast<std::uint16_t>(low + x);
  Levels levels;
  agc.show(line, levels);
  CHECK(levels.at(0, 0) <= 2);
  CHECK(levels.at(high - low, 0) >= 253);
  for (int x = 0; x + kBinCounts < high - low; ++x)
    REQUIRE(levels.at(x + kBinCounts, 0) - levels.at(x, 0) <= (clip_limit + 1) * 255 / bins + 1);
}

TEST_CASE("clahe shows a faint target as well on either side of a large difference") {
  Counts counts = ground(160, 128, 0, 5);
  for (int y = 0; y < 128; ++y)
    for (int x = 80; x < 160; ++x) counts.at(x, y) = static_cast<std::uint16_t>(counts.at(x, y) + 3000);
  for (const int x : {20, 140}) counts.at(x, 64) = static_cast<std::uint16_t>(counts.at(x, 64) + 60);
  const Levels levels = shown({.tail_percent = 0}, counts);
  CHECK(levels.at(20, 64) - levels.at(24, 64) > 40);
  CHECK(levels.at(140, 64) - levels.at(136, 64) > 40);
}

TEST_CASE("clahe never spreads one NETD over more than the largest gain") {
  const double gain = GENERATE(2.0, 8.0);
  const int noise = GENERATE(1, 5, 100);
  const Counts counts = ground(90, 70, 40, noise);
  Agc agc = clahe({.max_gain_dn_per_netd = gain});
  const Levels levels = shown(agc, counts);
  Counts warmer = counts;
  for (std::uint16_t& count : warmer.pixels()) count = static_cast<std::uint16_t>(count + 5);  // one NETD
  Levels after;
  agc.show(warmer, after);
  int steepest = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    steepest = std::max(steepest, after.pixels()[i] - levels.pixels()[i]);
  CHECK(steepest > 0);
  CHECK(steepest <= gain + 1);  // rounding may add a level
}

TEST_CASE("clahe is continuous from tile to tile") {
  const Counts counts = ground(320, 256, 2000, 0);
  const Levels levels = shown({}, counts);
  int largest = 0;
  for (int x = 1; x < 320; ++x)
    largest = std::max(largest, std::abs(levels.at(x, 100) - levels.at(x - 1, 100)));
  CHECK(largest <= 13);  // 6 counts a pixel, at most 8 levels for 5 of them, and what the tiles differ in
}

TEST_CASE("clahe gives the same bits with any number of threads, and black_hot is 255 less") {
  const Counts counts = ground(123, 97, 700, 60);
  const AgcParameters parameters = {.tiles_across = 5, .tiles_down = 7};
  const Levels one = with_threads(1, [&] { return shown(parameters, counts); });
  CHECK(with_threads(4, [&] { return shown(parameters, counts); }) == one);
  AgcParameters black = parameters;
  black.polarity = Polarity::black_hot;
  const Levels turned = shown(black, counts);
  for (std::size_t i = 0; i < one.size(); ++i) REQUIRE(turned.pixels()[i] == 255 - one.pixels()[i]);
}

TEST_CASE("clahe ignores what is not measured, and a tile without anything else takes the frame's curve") {
  Counts counts = ground(80, 64, 300, 30);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 40; ++x) counts.at(x, y) = x % 2 == 0 ? 0 : 65535;
  const Levels levels = shown({.tiles_across = 2, .tiles_down = 2}, counts);
  CHECK(levels.at(0, 0) == 0);
  CHECK(levels.at(1, 0) == 255);
  const auto [low, high] = std::ranges::minmax(levels.row(60));
  CHECK(high - low > 100);
}

TEST_CASE("A first frame without any count is black in clahe, and a later one keeps the curves") {
  Agc agc = clahe({});
  const Levels dark = shown(agc, Counts(20, 10, 0));
  CHECK(std::ranges::all_of(dark.pixels(), [](std::uint8_t level) { return level == 0; }));
  const Counts counts = ground(20, 10, 300, 30);
  const Levels before = shown(agc, counts);
  (void)agc.next(Counts(20, 10, 0));
  Levels after;
  agc.show(counts, after);
  CHECK(after == before);
}

TEST_CASE("A change of scene fades in clahe by the damping's time constant") {
  const Counts before = ground(40, 32, 300, 30);
  Counts warmer = before;
  for (std::uint16_t& count : warmer.pixels()) count = static_cast<std::uint16_t>(count + 200);
  Agc agc = clahe({.damping_s = 0.5});
  (void)shown(agc, before);
  const Levels target = shown({}, warmer);
  Levels levels;
  for (int frame = 0; frame < 30; ++frame) levels = shown(agc, warmer);  // exp(-30 / 4.5) = 0.1 %
  for (std::size_t i = 0; i < levels.size(); ++i)
    REQUIRE(std::abs(levels.pixels()[i] - target.pixels()[i]) <= 1);
}

TEST_CASE("Any size and any number of tiles works in clahe") {
  const auto [width_px, height_px] =
      GENERATE(std::pair(1, 1), std::pair(3, 50), std::pair(50, 3), std::pair(65, 63));
  const int tiles = GENERATE(1, 2, 8, 64);
  const Levels levels =
      shown({.tiles_across = tiles, .tiles_down = tiles}, ground(width_px, height_px, 300, 30));
  CHECK(levels.width_px() == width_px);
}

}  // namespace local_tone_test
