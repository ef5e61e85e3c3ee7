#include "sensor/analogue_link.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "support/catch.h"
#include "support/planes.h"
#include "support/statistics.h"

namespace analogue_link_test {

using namespace thermal;
using planes::correlation;
using planes::covariance;
using planes::mean;

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

/// Mean levels of rows, every `step`-th from `first` on, as a column.
Plane<double> row_means(const Levels& picture, int first = 0, int step = 1) {
  Plane<double> means(1, (picture.height_px() - first + step - 1) / step);
  for (int i = 0; i < means.height_px(); ++i) {
    const auto row = picture.row(first + i * step);
    means.at(0, i) = std::accumulate(row.begin(), row.end(), 0.0) / static_cast<double>(row.size());
  }
  return means;
}

/// Amplitude of a wave along rows or columns, of a whole number of periods.
double amplitude(std::span<const double> values, double period) {
  double cosine = 0;
  double sine = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(i) / period;
    cosine += values[i] * std::cos(phase);
    sine += values[i] * std::sin(phase);
  }
  return 2 * std::hypot(cosine, sine) / static_cast<double>(values.size());
}

double wave(double at, double period) { return 127.5 + 120 * std::cos(2 * std::numbers::pi * at / period); }

Levels grey(int width_px, int height_px) { return {width_px, height_px, 128}; }

}  // namespace

TEST_CASE("A wide link without errors changes nothing") {
  const Levels picture = picture_of(67, 33, [](int x, int y) { return (37 * x + 91 * y) % 256; });
  CHECK(passed({.bandwidth_mhz = kWideMhz}, picture) == picture);
}

TEST_CASE("Half of the amplitude is left at the bandwidth, along rows alone") {
  const int period_px = GENERATE(4, 8, 16);
  CAPTURE(period_px);
  constexpr int kWidth = 640;
  const AnalogueLinkParameters link = {.bandwidth_mhz = kWidth / 52.0 / period_px};
  const Levels across = passed(link, picture_of(kWidth, 8, [&](int x, int) { return wave(x, period_px); }));
  double sum = 0;
  for (int x = 160; x < 480; ++x) sum += across.at(x, 4) * std::cos(2 * std::numbers::pi * x / period_px);
  CHECK_THAT(2 * sum / 320 / 120, WithinAbs(0.5, 0.02));
  const Levels down = picture_of(64, 64, [&](int, int y) { return wave(y, period_px); });
  CHECK(passed(link, down) == down);
}

TEST_CASE("The response along rows is that of the stated filter at every frequency") {
  constexpr int kWidth = 960;
  const double bandwidth_mhz = GENERATE(1.5, 4.2, 6.0);
  const int period_px = GENERATE(3, 4, 6, 8, 12, 16, 40);
  CAPTURE(bandwidth_mhz, period_px);
  const double frequency_mhz = kWidth / 52.0 / period_px;
  const Levels sent = passed({.bandwidth_mhz = bandwidth_mhz},
                             picture_of(kWidth, 2, [&](int x, int) { return wave(x, period_px); }));
  const std::vector<double> middle(&sent.at(240, 1), &sent.at(240, 1) + 480);  // borders are mirrored
  const double expected = std::exp(-std::numbers::ln2 * std::pow(frequency_mhz / bandwidth_mhz, 2));
  CHECK_THAT(amplitude(middle, period_px) / 120,
             WithinAbs(expected, 0.02));  // the kernel's 0.015, and rounding
}

TEST_CASE("Noise has the spectrum of the bandwidth along rows, and none down columns") {
  constexpr double kNoise = 20;
  constexpr int kWidth = 512;
  const double sigma_px = GENERATE(0.8, 1.5);
  CAPTURE(sigma_px);
  const double cycles_per_px = std::sqrt(std::numbers::ln2 / 2) / (std::numbers::pi * sigma_px);
  const Levels noisy =
      passed({.bandwidth_mhz = cycles_per_px * kWidth / 52, .noise_levels = kNoise}, grey(kWidth, 256));
  // Of white noise, a Gaussian leaves 1 / (2 sqrt(pi) sigma) of the variance. Rounding adds 1/12.
  const double variance = kNoise * kNoise / (2 * std::sqrt(std::numbers::pi) * sigma_px) + 1.0 / 12;
  CHECK_THAT(covariance(noisy, 0, 0) / variance, WithinAbs(1, 0.05));
  CHECK_THAT(correlation(noisy, 1, 0), WithinAbs(std::exp(-1 / (4 * sigma_px * sigma_px)), 0.04));
  CHECK_THAT(correlation(noisy, 0, 1), WithinAbs(0, 0.02));
}

TEST_CASE("Streaks fade along rows as is asked for, with noise and without") {
  constexpr int kWidth = 520;  // 10 px a us
  const double noise = GENERATE(0.0, 10.0);
  CAPTURE(noise);
  const Levels streaks =
      passed({.bandwidth_mhz = kWideMhz, .noise_levels = noise, .streak_levels = 15, .streak_us = 0.8},
             grey(kWidth, 512));
  // 16 pixels are one: a standard error of 1.1 % of the variance.
  const double variance = 225 + noise * noise;
  CHECK_THAT(covariance(streaks, 0, 0) / variance, WithinAbs(1, 0.04));
  for (const int lag : {1, 8, 16}) {
    CAPTURE(lag);
    CHECK_THAT(correlation(streaks, lag, 0), WithinAbs(225 / variance * std::exp(-lag / 8.0), 0.03));
  }
  CHECK_THAT(correlation(streaks, 0, 1), WithinAbs(0, 0.03));
}

TEST_CASE("Streaks are the same at either end of a row") {
  const Levels streaks = passed(
      {.bandwidth_mhz = kWideMhz, .noise_levels = 4, .streak_levels = 15, .streak_us = 0.8}, grey(520, 4000));
  // Of 4,000 rows: a standard error of 2.2 % of the variance.
  for (const int x : {0, 1, 260, 519}) {
    CAPTURE(x);
    Levels column(1, 4000);
    for (int y = 0; y < 4000; ++y) column.at(0, y) = streaks.at(x, y);
    CHECK_THAT(covariance(column, 0, 0) / (225 + 16), WithinAbs(1, 0.12));
  }
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

TEST_CASE("A comb's amplitude follows motion as far as half a period of what moves") {
  constexpr int kPeriod = 16;
  const float field_px = GENERATE(2.0F, 4.0F, 8.0F, 12.0F);
  CAPTURE(field_px);
  const Levels still = picture_of(160, 20, [](int x, int) { return wave(x, kPeriod); });
  Levels combed = still;
  AnalogueLink link({.bandwidth_mhz = kWideMhz}, {.id = "clip", .width_px = 160, .height_px = 20});
  link.pass(field_px, combed);
  std::vector<double> comb;
  for (int x = 40; x < 120; ++x) comb.push_back(0.5 * (combed.at(x, 10) - combed.at(x, 11)));
  const double expected =
      120 * std::abs(std::sin(std::numbers::pi * static_cast<double>(field_px) / kPeriod));
  CHECK_THAT(amplitude(comb, kPeriod), WithinAbs(expected, 0.5));
  // 25 Hz are two fields a frame.
  CHECK(combed == passed({.bandwidth_mhz = kWideMhz}, still, motion_of(160, 20, 2 * field_px, 0), 25));
}

TEST_CASE("Lines of the standard keep what is straight, and soften columns as interpolation does") {
  const AnalogueLinkParameters link = {.lines = 576, .bandwidth_mhz = kWideMhz};
  const Levels ramp = picture_of(20, 200, [](int x, int y) { return 20 + x + y; });
  const Levels back = passed(link, ramp);
  for (int y = 1; y < 199; ++y) CHECK(std::abs(back.at(10, y) - ramp.at(10, y)) <= 1);
  const int period_px = GENERATE(4, 8, 16);
  CAPTURE(period_px);
  const Levels soft = passed(link, picture_of(2, 512, [&](int, int y) { return wave(y, period_px); }));
  const Plane<double> column = row_means(soft);
  // 9 lines for 8 rows: a row's centre is a = (2 j + 1) / 16 of the way between two lines, 8/9 of a row apart. There, the
  // chord is a (1 - a) 8/9 below a corner between rows, and corners are 2 (1 - cos) sharp. The mean of a (1 - a):
  const double between = 1.0 / 6 + 1.0 / 768;
  const double lost = 2 * (1 - std::cos(2 * std::numbers::pi / period_px)) * 8 / 9 * between;
  CHECK_THAT(amplitude(column.pixels(), period_px) / 120, WithinAbs(1 - lost, 0.01));
}

TEST_CASE("Lines of the standard are combed too, and fewer lines than rows lose detail alone") {
  const Levels picture = picture_of(40, 512, [](int x, int y) { return 100 + 2 * x + 0.1 * y; });
  for (const int lines : {480, 576}) {
    CAPTURE(lines);
    const AnalogueLinkParameters link = {.lines = lines, .bandwidth_mhz = kWideMhz};
    const Levels still = passed(link, picture);
    const Levels moved = passed(link, picture, motion_of(40, 512, 8, 0));
    for (int y = 1; y < 511; ++y) CHECK(std::abs(still.at(20, y) - picture.at(20, y)) <= 1);
    const Plane<double> rows = row_means(moved, 100);
    CHECK(covariance(rows, 0, 0) > covariance(row_means(still, 100), 0, 0) + 4);
  }
}

TEST_CASE("Rows have errors of their own, and a drift that follows from row to row of a field") {
  constexpr int kRows = 20000;
  const Levels own = passed({.bandwidth_mhz = kWideMhz, .row_levels = 10}, grey(2, kRows));
  CHECK_THAT(std::sqrt(covariance(row_means(own), 0, 0)), WithinAbs(10, 0.3));
  CHECK_THAT(covariance(row_means(own), 0, 1) / 100, WithinAbs(0, 0.03));

  const Levels drifted =
      passed({.bandwidth_mhz = kWideMhz, .drift_levels = 10, .drift_rows = 8}, grey(2, kRows));
  const Plane<double> field = row_means(drifted, 1, 2);
  // Of 10,000 rows, 16 of which are one: a standard error of 6 % of the variance.
  CHECK_THAT(covariance(field, 0, 0) / 100, WithinAbs(1, 0.2));
  CHECK_THAT(correlation(field, 0, 1), WithinAbs(std::exp(-1.0 / 8), 0.03));
  CHECK_THAT(correlation(field, 0, 8), WithinAbs(std::exp(-1.0), 0.15));
}

TEST_CASE("Errors of rows have the power along columns that their correlation says") {
  constexpr int kLines = 128;
  constexpr int kPieces = 512;
  constexpr double kOwn = 6;
  constexpr double kDrift = 8;
  const AnalogueLinkParameters link = {
      .bandwidth_mhz = kWideMhz, .row_levels = kOwn, .drift_levels = kDrift, .drift_rows = 8};
  const Plane<double> field = row_means(passed(link, grey(1, 2 * kLines * kPieces)), 0, 2);
  const std::vector<double> cycles = {2, 8, 40};
  statistics::Spectrum spectrum(cycles, kLines, kPieces);
  for (int line = 0; line < kLines; ++line) {
    std::vector<float> levels;
    for (int piece = 0; piece < kPieces; ++piece)
      levels.push_back(static_cast<float>(field.at(0, piece * kLines + line) - 128));
    spectrum.add(line, levels);
  }
  const double follows = std::exp(-1.0 / 8);
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    CAPTURE(cycles[k]);
    const double cosine = std::cos(2 * std::numbers::pi * cycles[k] / kLines);
    const double drift = (1 - follows * follows) / (1 - 2 * follows * cosine + follows * follows);
    const double expected = kOwn * kOwn + kDrift * kDrift * drift + 1.0 / 12;
    // An exponential deviate a piece: a standard error of 4.4 %.
    CHECK_THAT(spectrum.power(k) / kPieces / expected, WithinAbs(1, 0.044 * statistics::kSigmas));
  }
}

TEST_CASE("Hum is a sine of the mains, which stands still if fields keep its rate") {
  const auto means_after = [](double hum_hz, int frames) {
    return row_means(
        passed({.bandwidth_mhz = kWideMhz, .hum_levels = 20, .hum_hz = hum_hz}, grey(2, 512), {}, 25, frames),
        0, 2);
  };
  const Plane<double> still = means_after(50, 0);
  CHECK(still == means_after(50, 7));
  CHECK_THAT(std::sqrt(covariance(still, 0, 0)), WithinAbs(20, 0.5));
  for (int line = 0; line < 128; ++line)
    CHECK(std::abs(still.at(0, line) + still.at(0, line + 128) - 256) <= 1.01);
  CHECK(means_after(60, 0) != means_after(60, 1));
}

TEST_CASE("Jitter moves rows by its deviation") {
  const Levels ramp = picture_of(100, 2000, [](int x, int) { return 28 + 2 * x; });
  const Levels moved = passed({.bandwidth_mhz = kWideMhz, .jitter_px = 3}, ramp);
  Plane<double> moved_px(1, 2000);
  for (int y = 0; y < 2000; ++y) moved_px.at(0, y) = (ramp.at(50, y) - moved.at(50, y)) / 2.0;
  CHECK_THAT(mean(moved_px), WithinAbs(0, 0.25));
  CHECK_THAT(std::sqrt(covariance(moved_px, 0, 0)), WithinAbs(3, 0.2));
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
