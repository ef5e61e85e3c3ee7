#include "sensor/agc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "support/agc_reference.h"
#include "support/cameras.h"
#include "support/catch.h"

namespace agc_test {

using namespace thermal;

namespace {

using Counts = Plane<std::uint16_t>;

constexpr double kFrameRate = 9;
const BandRadiance kBand(SpectralResponse::flat(8, 14));

AgcScene scene_of(double kelvin_per_count = 0.01) {
  return {.kelvin_per_count = kelvin_per_count,
          .frame_rate_hz = kFrameRate,
          .netd_k = 0.05,
          .brightest_w_m2_sr = 63.75,
          .temperature_of = [](double radiance) { return kBand.temperature(radiance); }};
}

/// Every 16-bit count once.
Counts all_counts() {
  Counts counts(256, 256);
  std::iota(counts.pixels().begin(), counts.pixels().end(), 0);
  return counts;
}

/// Levels of all counts, by count.
std::vector<int> levels_of(const ToneCurve& curve, Polarity polarity = Polarity::white_hot) {
  Plane<std::uint8_t> ir8;
  apply_tone_curve(curve, polarity, all_counts(), ir8);
  return {ir8.pixels().begin(), ir8.pixels().end()};
}

/// Normally distributed about a temperature, with a few outliers, some dark, some clipped.
Counts random_counts(int seed, double middle, double spread) {
  std::mt19937 random(static_cast<unsigned>(seed));
  Counts counts(80, 60);
  for (std::uint16_t& count : counts.pixels()) {
    double sum = -6;  // Irwin and Hall: near normal, the same on every machine
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0;
    const double value =
        random() % 50 == 0 ? 65535.0 * static_cast<double>(random() % 1001) / 1000 : middle + spread * sum;
    count = static_cast<std::uint16_t>(std::clamp(value, 0.0, 65535.0));
  }
  return counts;
}

/// Checks levels by count against their values before rounding. Within 1e-6 of a half, both are accepted.
template <typename LevelOf>
void check_levels(const ToneCurve& curve, LevelOf level_of) {
  const std::vector<int> levels = levels_of(curve);
  double worst = 0;
  for (int count = 1; count < 65535; ++count) {
    worst = std::max(worst, std::abs(levels[static_cast<std::size_t>(count)] - level_of(count)));
  }
  CHECK(worst <= 0.5 + 1e-6);
}

}  // namespace

TEST_CASE(
    "The curve of scene_max rounds, and that of table_max cuts off, the share of the brightest radiance") {
  const double kelvin_per_count = GENERATE(0.01, 0.04);
  const bool truncated = GENERATE(false, true);
  const AgcMode mode = truncated ? AgcMode::table_max : AgcMode::scene_max;
  Agc agc({.mode = mode}, scene_of(kelvin_per_count));
  const std::vector<int> levels = levels_of(agc.next(all_counts()));
  CHECK(levels.front() == 0);
  CHECK(levels.back() == 255);
  int wrong = 0;
  for (int count = 1; count < 65535; ++count) {
    // A level starts at the count to which its radiance rounds, so a count shows the level of its upper edge.
    const double upper_edge_k = (count + 0.5) * kelvin_per_count;
    const double share = 255 * kBand.radiance(upper_edge_k) / 63.75;
    const double level = std::min(255.0, std::floor(share + (truncated ? 0 : 0.5)));
    wrong += levels[static_cast<std::size_t>(count)] == static_cast<int>(level) ? 0 : 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("The script's levels are truncated and clipped, whole ones stay whole, NaN is dark") {
  constexpr float kLevel = 0.25F;
  Plane<float> radiance(7, 1);
  const std::array<float, 7> levels = {0, 99.99F, 100, 255, 256, -1, std::numeric_limits<float>::quiet_NaN()};
  for (int i = 0; i < 7; ++i) radiance.at(i, 0) = kLevel * levels[static_cast<std::size_t>(i)];
  Plane<std::uint8_t> ir8;
  truncate_to_levels(radiance, 63.75, Polarity::white_hot, ir8);
  CHECK(std::vector<int>(ir8.pixels().begin(), ir8.pixels().end()) ==
        std::vector<int>{0, 99, 100, 255, 255, 0, 0});
  truncate_to_levels(radiance, 63.75, Polarity::black_hot, ir8);
  CHECK(std::vector<int>(ir8.pixels().begin(), ir8.pixels().end()) ==
        std::vector<int>{255, 156, 155, 0, 0, 255, 255});
}

TEST_CASE("linear is a straight line between its temperatures") {
  Agc agc({.mode = AgcMode::linear, .low_k = 263, .high_k = 313.3}, scene_of());
  const ToneCurve curve = agc.next(Counts(3, 2));
  check_levels(curve, [](int count) { return agc_reference::linear_level({26300, 31330}, count); });
  CHECK_THAT(curve.low_k, WithinAbs(263, 1e-9));
  CHECK_THAT(curve.high_k, WithinAbs(313.3, 1e-9));
}

TEST_CASE("percentile is a straight line between percentiles, damped in time") {
  const double spread = GENERATE(3.0, 400.0);  // NETDs: the largest gain applies; or not
  const double damping_s = GENERATE(0.0, 0.7);
  const AgcParameters parameters = {.mode = AgcMode::percentile, .tail_percent = 0.8, .damping_s = damping_s};
  Agc agc(parameters, scene_of());
  const double share = damping_s == 0 ? 1 : 1 - std::exp(-1 / (kFrameRate * damping_s));
  agc_reference::Limits limits;
  for (int frame = 0; frame < 5; ++frame) {
    const Counts counts = random_counts(frame, 28000 + 100 * frame, spread);
    const auto wanted = agc_reference::percentile_limits(parameters, 5, counts);
    limits.low = frame == 0 ? wanted.low : limits.low + share * (wanted.low - limits.low);
    limits.high = frame == 0 ? wanted.high : limits.high + share * (wanted.high - limits.high);
    const ToneCurve& curve = agc.next(counts);
    CAPTURE(spread, damping_s, frame);
    CHECK_THAT(curve.low_k, WithinAbs(0.01 * limits.low, 1e-9));
    CHECK_THAT(curve.high_k, WithinAbs(0.01 * limits.high, 1e-9));
    check_levels(curve, [&limits](int count) { return agc_reference::linear_level(limits, count); });
  }
}

TEST_CASE("A tail drops the requested number of pixels, to the pixel") {
  Counts counts(200, 1);
  for (int i = 0; i < 200; ++i) counts.at(i, 0) = static_cast<std::uint16_t>(20000 + 50 * i);
  const int dropped = GENERATE(0, 1, 2, 50);
  const AgcMode mode = GENERATE(AgcMode::percentile, AgcMode::plateau, AgcMode::information);
  Agc agc({.mode = mode, .tail_percent = 0.5 * dropped}, scene_of());
  const ToneCurve& curve = agc.next(counts);
  CHECK_THAT(curve.low_k, WithinAbs(200 + 0.5 * dropped, 1e-9));
  CHECK_THAT(curve.high_k, WithinAbs(200 + 0.5 * (199 - dropped), 1e-9));
}

TEST_CASE("plateau equalises the histogram up to its plateau and its largest gain, damped in time") {
  const double spread = GENERATE(3.0, 400.0);
  const double plateau_percent = GENERATE(0.2, 5.0, 100.0);
  const AgcParameters parameters = {.mode = AgcMode::plateau, .plateau_percent = plateau_percent};
  const double kelvin_per_count = GENERATE(0.01, 0.1);  // four counts per bin; one
  const int bin_counts = kelvin_per_count == 0.01 ? 4 : 1;
  const double per_kelvin = 1 / kelvin_per_count;
  Agc agc(parameters, scene_of(kelvin_per_count));
  const double share = 1 - std::exp(-1 / (kFrameRate * parameters.damping_s));
  std::vector<double> levels;
  for (int frame = 0; frame < 3; ++frame) {
    const Counts counts = random_counts(frame, (280 + frame) * per_kelvin, 0.01 * spread * per_kelvin);
    const std::vector<double> wanted =
        agc_reference::plateau_levels(parameters, 0.05 * per_kelvin, bin_counts, counts);
    if (frame == 0) levels = wanted;
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i] += share * (wanted[i] - levels[i]);
    CAPTURE(spread, plateau_percent, kelvin_per_count, frame);
    check_levels(agc.next(counts), [&levels, bin_counts](int count) {
      return agc_reference::level_between(levels, bin_counts, count);
    });
  }
}

TEST_CASE("A share of a straight line is mixed into an equalised curve, and levels of gaps are kept") {
  const AgcMode mode = GENERATE(AgcMode::plateau, AgcMode::information);
  Counts counts(100, 100, 28000);  // two temperatures, 20 K apart, and one pixel between
  for (int y = 50; y < 100; ++y)
    for (int x = 0; x < 100; ++x) counts.at(x, y) = 30000;
  counts.at(0, 50) = 29000;
  const auto curve_of = [&](double linear_percent) {
    const AgcParameters parameters = {.mode = mode,
                                      .tail_percent = 0,
                                      .plateau_percent = 100,
                                      .linear_percent = linear_percent,
                                      .max_gain_dn_per_netd = 255};
    Agc agc(parameters, scene_of());
    return levels_of(agc.next(counts));
  };
  const std::vector<int> equalised = curve_of(0);
  const std::vector<int> mixed = curve_of(20);
  const std::vector<int> straight = curve_of(100);
  int wrong = 0;
  for (std::size_t count = 28000; count <= 30000; ++count) {
    // Bins of 4 counts, 501 of them; each of the three levels is rounded.
    const double line = 255 * (static_cast<double>(count) + 1 - 28000) / 2004;
    wrong += std::abs(straight[count] - line) <= 1 ? 0 : 1;
    wrong += std::abs(mixed[count] - (0.8 * equalised[count] + 0.2 * straight[count])) <= 1.1 ? 0 : 1;
  }
  CHECK(wrong == 0);
  CHECK(equalised[29900] - equalised[29100] == 0);
  CHECK(mixed[29900] - mixed[29100] >= 19);  // 0.2 x 255 x 800 / 2004 = 20.4
}

TEST_CASE("No adaptive mode spreads one NETD over more than the largest gain") {
  const AgcMode mode = GENERATE(AgcMode::percentile, AgcMode::plateau, AgcMode::information);
  const double spread = GENERATE(0.0, 1.0, 5.0, 60.0, 2000.0);
  const double gain = GENERATE(2.0, 8.0);
  Agc agc({.mode = mode, .max_gain_dn_per_netd = gain}, scene_of());
  const std::vector<int> levels = levels_of(agc.next(random_counts(1, 29000, spread)));
  CHECK(std::is_sorted(levels.begin(), levels.end()));
  int steepest = 0;
  for (std::size_t count = 1; count + 5 < levels.size() - 1; ++count) {
    steepest = std::max(steepest, levels[count + 5] - levels[count]);  // 5 counts are one NETD
  }
  CHECK(steepest <= gain + 1);  // rounding may add a level
}

TEST_CASE("A scene of pure noise keeps its noise below the largest gain") {
  const AgcMode mode = GENERATE(AgcMode::percentile, AgcMode::plateau, AgcMode::information, AgcMode::clahe);
  SensorParameters parameters;  // white noise of 40 mK at 300 K
  parameters.agc.mode = mode;
  ThermalCamera camera = cameras::camera(parameters, {.width_px = 160, .height_px = 120});
  const SensorFrame frame = camera.expose(cameras::uniform_scene(160, 120, 300));
  double sum = 0;
  double squares = 0;
  for (const std::uint8_t level : frame.ir8.pixels()) {
    sum += level;
    squares += level * level;
  }
  const double mean = sum / 19200;
  // 8 levels and a twelfth of a level squared for rounding; 5 sigma of the deviation of 19,200 normals. The
  // quantisation to 16-bit counts adds 1/12 of 0.25 NETD squared: 2 levels squared over 12.
  const double most = std::sqrt(64 + 1.0 / 12 + 4.0 / 12) * (1 + 5 / std::sqrt(2 * 19200.0));
  CHECK(std::sqrt(squares / 19200 - mean * mean) <= most);
  CHECK_THAT(mean, WithinAbs(127.5, 8));
}

TEST_CASE("black_hot is 255 less white_hot") {
  const AgcMode mode = GENERATE(AgcMode::scene_max, AgcMode::linear, AgcMode::percentile, AgcMode::plateau);
  Agc agc({.mode = mode}, scene_of());
  const ToneCurve& curve = agc.next(random_counts(1, 29000, 100));
  const std::vector<int> white = levels_of(curve);
  const std::vector<int> black = levels_of(curve, Polarity::black_hot);
  std::vector<int> turned;
  for (const int level : white) turned.push_back(255 - level);
  CHECK(black == turned);
}

TEST_CASE("A change of scene fades by the damping's time constant") {
  const double damping_s = GENERATE(0.1, 0.5, 3.0);
  Agc agc({.mode = AgcMode::percentile, .damping_s = damping_s}, scene_of());
  const double before_k = agc.next(random_counts(1, 28000, 300)).high_k;
  Agc adapted({.mode = AgcMode::percentile}, scene_of());
  const Counts after = random_counts(2, 30000, 300);
  const double after_k = adapted.next(after).high_k;
  for (int frame = 1; frame < 30; ++frame) {
    const double left = std::exp(-frame / (kFrameRate * damping_s));
    REQUIRE_THAT(agc.next(after).high_k, WithinAbs(after_k + left * (before_k - after_k), 1e-9));
  }
}

TEST_CASE("information is plateau if flat pixels count in full") {
  const AgcParameters weighted = {.mode = AgcMode::information, .flat_weight = 1};
  Agc information(weighted, scene_of());
  Agc plateau({.mode = AgcMode::plateau}, scene_of());
  for (int frame = 0; frame < 3; ++frame) {
    const Counts counts = random_counts(frame, 28000, 200);
    CHECK(information.next(counts) == plateau.next(counts));
  }
}

TEST_CASE("information gives flat ground fewer levels than plateau, and a textured part more") {
  Counts counts(80, 60);  // flat ground with noise of one NETD above, stripes of +- 6 NETDs about 300 K below
  std::mt19937 random(1);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const int noise = static_cast<int>(random() % 11) - 5;
      const int middle = y < 40 ? 28000 : 30000 + (x / 2 % 2 == 0 ? 30 : -30);
      counts.at(x, y) = static_cast<std::uint16_t>(middle + noise);
    }
  const auto levels_over = [&](AgcMode mode, std::size_t low, std::size_t high) {
    Agc agc({.mode = mode, .plateau_percent = 100, .max_gain_dn_per_netd = 255}, scene_of());
    const std::vector<int> levels = levels_of(agc.next(counts));
    return levels[high] - levels[low];
  };
  const int flat = levels_over(AgcMode::information, 27990, 28010);
  const int textured = levels_over(AgcMode::information, 29960, 30040);
  CAPTURE(flat, textured);
  // 3200 flat pixels, of which those beside the stripes have information: (3120 x 0.1 + 80) of 255 levels.
  CHECK_THAT(flat, WithinAbs(255 * (312.0 + 80) / (312 + 80 + 1600), 4));
  CHECK_THAT(textured, WithinAbs(255 * 1600.0 / (312 + 80 + 1600), 4));
  CHECK(levels_over(AgcMode::plateau, 27990, 28010) > 2 * flat);
}

TEST_CASE("Levels keep the headroom that is asked for, in all modes but the published script's") {
  const AgcMode mode = GENERATE(AgcMode::scene_max, AgcMode::linear, AgcMode::percentile, AgcMode::plateau,
                                AgcMode::information, AgcMode::clahe);
  CAPTURE(static_cast<int>(mode));
  const Counts counts = random_counts(3, 28000, 300);
  const auto levels = [&](int black, int white) {
    Agc agc({.mode = mode, .black_level = black, .white_level = white}, scene_of());
    agc.next(counts);
    Plane<std::uint8_t> ir8;
    agc.show(counts, ir8);
    return ir8;
  };
  const Plane<std::uint8_t> full = levels(0, 255);
  const Plane<std::uint8_t> less = levels(12, 244);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::uint16_t count = counts.pixels()[i];
    const double scaled = 12 + full.pixels()[i] * 232.0 / 255;
    if (count == 0) REQUIRE(less.pixels()[i] == 0);
    if (count == 65535) REQUIRE(less.pixels()[i] == 255);
    if (count != 0 && count != 65535) REQUIRE(std::abs(less.pixels()[i] - scaled) <= 0.5);
  }
}

}  // namespace agc_test
