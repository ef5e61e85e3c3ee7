#include "analysis/compare/noise.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"
#include "support/grey_frames.h"

namespace noise_test {

using namespace thermal;
using grey_frames::frame_of;
using grey_frames::normal;
using grey_frames::white;

namespace {

constexpr int kWidth = 50;
constexpr int kHeight = 40;
constexpr int kFrames = 200;

double scene(int x, int y) { return 100 + 30 * std::sin(0.3 * x) + 20 * std::cos(0.2 * y * x); }

/// Noise of each pixel, row, column and frame over a scene that stays, or over none.
std::vector<Plane<float>> footage(bool with_scene) {
  std::vector<Plane<float>> frames;
  const auto pixels = normal(std::size_t{kWidth} * kHeight * kFrames, 10);
  const auto rows = normal(std::size_t{kHeight} * kFrames, 11);
  const auto columns = normal(std::size_t{kWidth} * kFrames, 12);
  const auto whole = normal(kFrames, 13);
  for (int t = 0; t < kFrames; ++t) {
    frames.push_back(frame_of(kWidth, kHeight, [&](int x, int y) {
      const auto at = [](const std::vector<float>& values, int k) {
        return static_cast<double>(values[static_cast<std::size_t>(k)]);
      };
      return (with_scene ? scene(x, y) : 100) + 2 * at(pixels, (t * kHeight + y) * kWidth + x) +
             1 * at(rows, t * kHeight + y) + 0.5 * at(columns, t * kWidth + x) + 0.8 * at(whole, t);
    }));
  }
  return frames;
}

/// Five deviations of an estimated deviation with this many degrees of freedom.
double tolerance(double freedom) { return 5 / std::sqrt(2 * freedom); }

}  // namespace

TEST_CASE("The three-dimensional noise model finds each component") {
  const VideoNoise noise = video_noise(footage(false));
  CHECK_THAT(noise.random, WithinRel(2.0, tolerance(199.0 * 39 * 49)));
  CHECK_THAT(noise.rows,
             WithinRel(1.0, 1.1 * tolerance(199.0 * 39)));  // a tenth more for the pixels' noise in rows
  CHECK_THAT(noise.columns, WithinRel(0.5, 1.5 * tolerance(199.0 * 49)));
  CHECK_THAT(noise.frames, WithinRel(0.8, 1.1 * tolerance(199)));
}

TEST_CASE("A scene that stays is no noise") {
  const VideoNoise without = video_noise(footage(false));
  const VideoNoise with = video_noise(footage(true));
  CHECK_THAT(with.random, WithinRel(without.random, 1e-5));  // levels are rounded to 24 bits
  CHECK_THAT(with.rows, WithinRel(without.rows, 1e-4));
  CHECK_THAT(with.columns, WithinRel(without.columns, 1e-4));
  CHECK_THAT(with.frames, WithinRel(without.frames, 1e-4));
}

TEST_CASE("Frames without noise have none") {
  const VideoNoise noise = video_noise(std::vector(3, frame_of(kWidth, kHeight, scene)));
  CHECK(noise.random < 1e-6);
  CHECK(noise.rows < 1e-6);
  CHECK(noise.columns < 1e-6);
  CHECK(noise.frames < 1e-6);
}

TEST_CASE("Noise in flat blocks is that of a tenth of them, a little below the deviation") {
  // Of 1,280 blocks with 253 degrees of freedom: the 10th percentile is 5.7 % below, and scatters by 0.2 %.
  const auto slope = [](const Plane<float>& noise) {
    return frame_of(noise.width_px(), noise.height_px(), [&noise](int x, int y) {
      return 60 + 0.1 * x + 0.05 * y + static_cast<double>(noise.at(x, y));
    });
  };
  CHECK_THAT(flat_noise(white(640, 512, 100, 3)).value().deviation, WithinRel(3 * 0.943, 0.012));
  CHECK_THAT(flat_noise(slope(white(640, 512, 0, 3))).value().deviation, WithinRel(3 * 0.943, 0.012));
}

TEST_CASE("Blocks that are black or white are not flat") {
  CHECK_FALSE(flat_noise(Plane<float>(640, 512, 0.0F)));
  CHECK_FALSE(flat_noise(Plane<float>(640, 512, 255.0F)));
  CHECK_FALSE(flat_noise(white(32, 32, 100, 3)));  // 4 blocks
  const auto level = flat_noise(Plane<float>(640, 512, 90.0F)).value();
  CHECK(level.deviation == 0);
  CHECK_FALSE(level.along_rows);
}

TEST_CASE("White noise is uncorrelated, and filtered noise correlates as its filter says") {
  // Correlations of a block scatter by 1 / sqrt(225), their median over 128 blocks by .0074.
  const auto plain = flat_noise(white(640, 512, 100, 3)).value();
  CHECK_THAT(plain.along_rows.value(), WithinAbs(0.0, 0.03));
  CHECK_THAT(plain.diagonal.value(), WithinAbs(0.0, 0.03));
  // A plane takes 3 of a block's 256 / (4 pi sigma^2) independent values, which all correlate.
  constexpr double kSigma = 0.8;
  const double taken = 3 * 4 * std::numbers::pi * kSigma * kSigma / 256;
  const Plane<float> noise = white(660, 532, 0, 20);
  const Plane<float> filtered = frame_of(640, 512, [&noise](int x, int y) {
    double sum = 0;
    for (int dy = -4; dy <= 4; ++dy)
      for (int dx = -4; dx <= 4; ++dx)
        sum += std::exp(-0.5 * (dx * dx + dy * dy) / (kSigma * kSigma)) *
               static_cast<double>(noise.at(x + 8 + dx, y + 8 + dy));
    return 100 + sum / (2 * std::numbers::pi * kSigma * kSigma);
  });
  const auto found = flat_noise(filtered).value();
  const auto expected = [taken](double squared_px) {
    return (std::exp(-squared_px / (4 * kSigma * kSigma)) - taken) / (1 - taken);
  };
  // The flattest tenth has, by chance, less of what varies slowly: its variance is a fifth less, and that is missing in
  // the correlation, too. (.64 - m) / (1 - m) is .59 for m = 0.13, and .55 for m = 0.2.
  CHECK(found.along_rows.value() < expected(1));
  CHECK(found.along_rows.value() > (expected(1) - 0.2) / 0.8);
  CHECK(found.diagonal.value() < expected(2));
  CHECK(found.diagonal.value() > (expected(2) - 0.2) / 0.8);
}

TEST_CASE("A scene stands still, moves by a pixel, or is another") {
  // Smoothed over 4 x 4 px: of deviation 20, with a grain that noise does not have.
  const auto texture = normal(std::size_t{200} * 200, 20);
  const auto shot = [&texture](int shift, std::uint32_t draw) {
    const auto noise = normal(std::size_t{160} * 128, draw);
    return frame_of(160, 128, [&](int x, int y) {
      double sum = 0;
      for (int k = 0; k < 16; ++k)
        sum += static_cast<double>(texture[static_cast<std::size_t>((y + k / 4) * 200 + x + shift + k % 4)]);
      return 100 + 5 * sum + static_cast<double>(noise[static_cast<std::size_t>(y * 160 + x)]);
    });
  };
  CHECK(is_still({shot(0, 30), shot(0, 31), shot(0, 32)}));
  CHECK_FALSE(is_still({shot(0, 30), shot(0, 31), shot(1, 32)}));
  CHECK_FALSE(is_still({shot(0, 30), shot(0, 31), white(160, 128, 100, 5, 40)}));
  CHECK_FALSE(is_still({shot(0, 30), white(64, 64, 100, 5, 40), shot(0, 31)}));
}

}  // namespace noise_test
