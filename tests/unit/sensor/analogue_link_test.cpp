#include "sensor/analogue_link.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "support/catch.h"

namespace analogue_link_test {

using namespace thermal;

namespace {

using Levels = Plane<std::uint8_t>;

constexpr double kWideMhz = 1000;  // no pixel gets anything of its neighbours

Levels picture_of(int width_px, int height_px, const std::function<double(int x, int y)>& level) {
  Levels picture(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) picture.at(x, y) = static_cast<std::uint8_t>(std::lround(level(x, y)));
  return picture;
}

Levels passed(const AnalogueLinkParameters& link, Levels picture, const ImageMotion& motion = {},
              double frame_rate_hz = 25, int skipped = 0) {
  AnalogueLink to({link}, {.id = "clip",
                           .frame_rate_hz = frame_rate_hz,
                           .width_px = picture.width_px(),
                           .height_px = picture.height_px()});
  for (int i = 0; i < skipped; ++i) to.skip();
  to.pass(motion, picture);
  return picture;
}

ImageMotion motion_of(int width_px, int height_px, float right_px, float down_px) {
  return {Plane<float>(width_px, height_px, right_px), Plane<float>(width_px, height_px, down_px)};
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Covariance of a series with itself `lag` later.
double covariance(const std::vector<double>& values, std::size_t lag) {
  const double middle = mean(values);
  double sum = 0;
  for (std::size_t i = lag; i < values.size(); ++i) sum += (values[i] - middle) * (values[i - lag] - middle);
  return sum / static_cast<double>(values.size() - lag);
}

/// Mean levels of rows, every `step`-th from `first` on.
std::vector<double> row_means(const Levels& picture, int first = 0, int step = 1) {
  std::vector<double> means;
  for (int y = first; y < picture.height_px(); y += step) {
    const auto row = picture.row(y);
    means.push_back(std::accumulate(row.begin(), row.end(), 0.0) / static_cast<double>(row.size()));
  }
  return means;
}

Levels grey(int width_px, int height_px) { return {width_px, height_px, 128}; }

}  // namespace

TEST_CASE("A wide link without errors changes nothing") {
  const Levels picture = picture_of(67, 33, [](int x, int y) { return (37 * x + 91 * y) % 256; });
  CHECK(passed({.bandwidth_mhz = kWideMhz}, picture) == picture);
}

TEST_CASE("Half of the amplitude is left at the bandwidth, along rows alone") {
  const int period_px = GENERATE(4, 8, 16);
  CAPTURE(period_px);
  const auto wave = [&](int at) { return 127.5 + 120 * std::cos(2 * std::numbers::pi * at / period_px); };
  constexpr int kWidth = 640;
  const AnalogueLinkParameters link = {.bandwidth_mhz = kWidth / 52.0 / period_px};
  const Levels across = passed(link, picture_of(kWidth, 8, [&](int x, int) { return wave(x); }));
  double sum = 0;
  for (int x = 160; x < 480; ++x) sum += across.at(x, 4) * std::cos(2 * std::numbers::pi * x / period_px);
  CHECK_THAT(2 * sum / 320 / 120, WithinAbs(0.5, 0.02));
  const Levels down = picture_of(64, 64, [&](int, int y) { return wave(y); });
  CHECK(passed(link, down) == down);
}

TEST_CASE("Noise has the spectrum of the bandwidth along rows, and none down columns") {
  constexpr double kNoise = 20;
  constexpr int kWidth = 512;
  const double sigma_px = GENERATE(0.8, 1.5);
  CAPTURE(sigma_px);
  const double cycles_per_px = std::sqrt(std::numbers::ln2 / 2) / (std::numbers::pi * sigma_px);
  const Levels noisy =
      passed({.bandwidth_mhz = cycles_per_px * kWidth / 52, .noise_levels = kNoise}, grey(kWidth, 256));
  const std::vector<double> levels(noisy.pixels().begin(), noisy.pixels().end());
  // Of white noise, a Gaussian leaves 1 / (2 sqrt(pi) sigma) of the variance. Rounding adds 1/12.
  const double variance = kNoise * kNoise / (2 * std::sqrt(std::numbers::pi) * sigma_px) + 1.0 / 12;
  CHECK_THAT(covariance(levels, 0) / variance, WithinAbs(1, 0.05));
  const double next = std::exp(-1 / (4 * sigma_px * sigma_px));
  CHECK_THAT(covariance(levels, 1) / covariance(levels, 0), WithinAbs(next, 0.04));
  CHECK_THAT(covariance(levels, kWidth) / covariance(levels, 0), WithinAbs(0, 0.02));
}

TEST_CASE("Streaks fade along rows as is asked for") {
  constexpr int kWidth = 520;  // 10 px a us
  const Levels streaks =
      passed({.bandwidth_mhz = kWideMhz, .streak_levels = 15, .streak_us = 0.8}, grey(kWidth, 512));
  const std::vector<double> levels(streaks.pixels().begin(), streaks.pixels().end());
  // 16 pixels are one: a standard error of 1.1 % of the variance.
  CHECK_THAT(covariance(levels, 0) / 225, WithinAbs(1, 0.04));
  for (const std::size_t lag : {1U, 8U, 16U}) {
    CAPTURE(lag);
    // Of each row, as many pairs as its lag is long are of two rows.
    const double pairs = 1 - static_cast<double>(lag) / kWidth;
    const double expected = pairs * std::exp(-static_cast<double>(lag) / 8);
    CHECK_THAT(covariance(levels, lag) / covariance(levels, 0), WithinAbs(expected, 0.03));
  }
  CHECK_THAT(covariance(levels, kWidth) / covariance(levels, 0), WithinAbs(0, 0.03));
}

TEST_CASE("What moves is combed by its way between two fields") {
  const double frame_rate_hz = GENERATE(9.0, 25.0);
  const float right_px = GENERATE(-6.0F, 2.0F);
  const float down_px = GENERATE(0.0F, 4.0F);
  CAPTURE(frame_rate_hz, right_px, down_px);
  const Levels ramp = picture_of(60, 60, [](int x, int y) { return 20 + 2 * x + y; });
  const Levels combed =
      passed({.bandwidth_mhz = kWideMhz}, ramp, motion_of(60, 60, right_px, down_px), frame_rate_hz);
  const double fields = frame_rate_hz / 50;
  const double comb = fields * static_cast<double>(2 * right_px + down_px);  // even rows against odd ones
  for (int y = 21; y < 40; y += 2) {
    const double even = 0.5 * (combed.at(30, y - 1) + combed.at(30, y + 1));
    CHECK_THAT(even - combed.at(30, y), WithinAbs(comb, 1.01));  // two roundings
  }
  for (const Deinterlace how : {Deinterlace::bob, Deinterlace::blend}) {
    const Levels whole = passed({.bandwidth_mhz = kWideMhz, .deinterlace = how}, ramp,
                                motion_of(60, 60, right_px, down_px), frame_rate_hz);
    for (int y = 20; y < 40; ++y) CHECK(std::abs(whole.at(30, y + 1) - whole.at(30, y) - 1) <= 1);
  }
}

TEST_CASE("Rows have errors of their own, and a drift that follows from row to row of a field") {
  constexpr int kRows = 20000;
  const Levels own = passed({.bandwidth_mhz = kWideMhz, .row_levels = 10}, grey(2, kRows));
  CHECK_THAT(std::sqrt(covariance(row_means(own), 0)), WithinAbs(10, 0.3));
  CHECK_THAT(covariance(row_means(own), 1) / 100, WithinAbs(0, 0.03));

  const Levels drifted =
      passed({.bandwidth_mhz = kWideMhz, .drift_levels = 10, .drift_rows = 8}, grey(2, kRows));
  const std::vector<double> field = row_means(drifted, 1, 2);
  // Of 10,000 rows, 16 of which are one: a standard error of 6 % of the variance.
  CHECK_THAT(covariance(field, 0) / 100, WithinAbs(1, 0.2));
  CHECK_THAT(covariance(field, 1) / covariance(field, 0), WithinAbs(std::exp(-1.0 / 8), 0.03));
  CHECK_THAT(covariance(field, 8) / covariance(field, 0), WithinAbs(std::exp(-1.0), 0.15));
}

TEST_CASE("Hum is a sine of the mains, which stands still if fields keep its rate") {
  const auto means_after = [](double hum_hz, int frames) {
    return row_means(
        passed({.bandwidth_mhz = kWideMhz, .hum_levels = 20, .hum_hz = hum_hz}, grey(2, 512), {}, 25, frames),
        0, 2);
  };
  const std::vector<double> still = means_after(50, 0);
  CHECK(still == means_after(50, 7));
  CHECK_THAT(std::sqrt(covariance(still, 0)), WithinAbs(20, 0.5));
  for (std::size_t line = 0; line < 128; ++line)
    CHECK(std::abs(still[line] + still[line + 128] - 256) <= 1.01);
  CHECK(means_after(60, 0) != means_after(60, 1));
}

TEST_CASE("Jitter moves rows by its deviation") {
  const Levels ramp = picture_of(100, 2000, [](int x, int) { return 28 + 2 * x; });
  const Levels moved = passed({.bandwidth_mhz = kWideMhz, .jitter_px = 3}, ramp);
  std::vector<double> moved_px;
  for (int y = 0; y < 2000; ++y) moved_px.push_back((ramp.at(50, y) - moved.at(50, y)) / 2.0);
  CHECK_THAT(mean(moved_px), WithinAbs(0, 0.25));
  CHECK_THAT(std::sqrt(covariance(moved_px, 0)), WithinAbs(3, 0.2));
}

TEST_CASE("Dropouts take the share of pixels that their rate and length say") {
  constexpr int kWidth = 520;  // 10 px a us
  constexpr int kHeight = 400;
  double lost = 0;
  constexpr int kFrames = 40;
  for (int frame = 0; frame < kFrames; ++frame) {
    const Levels dropped = passed({.bandwidth_mhz = kWideMhz, .dropouts_per_s = 1000, .dropout_us = 2},
                                  grey(kWidth, kHeight), {}, 25, frame);
    for (const std::uint8_t level : dropped.pixels()) {
      REQUIRE((level == 0 || level == 128 || level == 255));
      lost += level == 128 ? 0 : 1;
    }
  }
  // 40 a frame of a mean of 20 px, rounded up: + 0.5. Some 4 % end at the border. A standard error of 3.5 %.
  CHECK_THAT(lost / kFrames / (40 * 20.5), WithinAbs(0.96, 0.12));
}

TEST_CASE("A frame depends on its number and the clip alone") {
  const AnalogueLinkParameters link = {.noise_levels = 5,
                                       .streak_levels = 2,
                                       .row_levels = 3,
                                       .drift_levels = 3,
                                       .jitter_px = 1,
                                       .dropouts_per_s = 100};
  const Levels third = passed(link, grey(50, 40), {}, 25, 2);
  CHECK(third == passed(link, grey(50, 40), {}, 25, 2));
  CHECK(third != passed(link, grey(50, 40), {}, 25, 3));
  CHECK(passed(link, grey(1, 1)).size() == 1);
}

}  // namespace analogue_link_test
