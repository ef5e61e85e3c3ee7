#include "sensor/bad_pixels.h"

#include <cmath>
#include <vector>

#include "support/catch.h"
#include "support/statistics.h"

namespace bad_pixels_test {

using namespace thermal;
using statistics::kSigmas;

namespace {

constexpr double kFrameRate = 30;

/// Height of every blinking pixel, frame by frame: 1 up, 0 down.
std::vector<std::vector<bool>> states(double blinking_hz, int side_px, int frames) {
  BadPixels bad({.blinking_share = 1, .blinking_ratio = 1, .blinking_hz = blinking_hz}, 5, "clip", kFrameRate,
                side_px, side_px);
  std::vector<std::vector<bool>> states;
  for (int frame = 0; frame < frames; ++frame) {
    Plane<float> picture(side_px, side_px);
    bad.apply(static_cast<std::uint32_t>(frame), 1, picture);
    std::vector<bool>& up = states.emplace_back();
    for (const float value : picture.pixels()) up.push_back(value > 0.5F);
  }
  return states;
}

}  // namespace

TEST_CASE("The number of bad pixels is the requested one") {
  constexpr double kPixels = 640 * 512;
  const BadPixels bad({.dead_share = 0.01, .blinking_share = 0.002}, 5, "clip", kFrameRate, 640, 512);
  // Binomial.
  CHECK_THAT(static_cast<double>(bad.dead().size()),
             WithinAbs(0.01 * kPixels, kSigmas * std::sqrt(0.01 * 0.99 * kPixels)));
  CHECK_THAT(static_cast<double>(bad.blinking().size()),
             WithinAbs(0.002 * kPixels, kSigmas * std::sqrt(0.002 * 0.998 * kPixels)));
}

TEST_CASE("A blinking pixel is up half the time, from the first frame on") {
  const auto up = states(1, 100, 40);
  for (const int frame : {0, 1, 20, 39}) {
    int count = 0;
    for (const bool value : up[static_cast<std::size_t>(frame)]) count += value ? 1 : 0;
    CHECK_THAT(count, WithinAbs(5000, kSigmas * 50));  // binomial of 10,000 and a half
  }
}

TEST_CASE("A blinking pixel jumps at the requested rate, without memory") {
  const double blinking_hz = GENERATE(0.5, 6.0);
  const auto up = states(blinking_hz, 60, 300);
  // Sampled at frames 1 / rate apart, a telegraph signal has changed with probability (1 - e^{-2 r / rate}) / 2: runs
  // are geometric.
  const double flip = (1 - std::exp(-2 * blinking_hz / kFrameRate)) / 2;
  std::vector<double> chances(3);  // in any frame; just after a jump; otherwise
  std::vector<double> jumps(3);
  for (std::size_t frame = 2; frame < up.size(); ++frame) {
    for (std::size_t i = 0; i < up[frame].size(); ++i) {
      const auto jumped = [&](std::size_t at) { return up[at][i] != up[at - 1][i]; };
      const std::size_t kind = jumped(frame - 1) ? 1 : 2;
      for (const std::size_t k : {std::size_t{0}, kind}) {
        chances[k] += 1;
        jumps[k] += jumped(frame) ? 1 : 0;
      }
    }
  }
  for (std::size_t k = 0; k < chances.size(); ++k) {
    CAPTURE(blinking_hz, k);
    CHECK_THAT(jumps[k], WithinAbs(flip * chances[k], kSigmas * std::sqrt(flip * (1 - flip) * chances[k])));
  }
}

TEST_CASE("Pixels fail at the requested rate, evenly over a clip") {
  constexpr double kPixels = 640 * 512;
  constexpr double kPerHour = 0.02;
  const BadPixels bad({.late_dead_per_hour = kPerHour}, 5, "clip", kFrameRate, 640, 512);
  const double frames_an_hour = 3600 * kFrameRate;
  double survivors = kPixels;
  for (int quarter = 0; quarter < 8; ++quarter) {
    double failed = 0;
    for (const BadPixels::LateDead& late : bad.late_dead()) {
      const double quarters = 4 * late.frame / frames_an_hour;
      failed += quarters >= quarter && quarters < quarter + 1 ? 1 : 0;
    }
    CAPTURE(quarter);
    const double share = -std::expm1(-kPerHour / 4);  // binomial
    CHECK_THAT(failed, WithinAbs(survivors * share, kSigmas * std::sqrt(survivors * share)));
    survivors -= failed;
  }
}

TEST_CASE("The first of few failures is not on a grid of times") {
  // A share of 1e-9 an hour is 2 % of a uniform number's last bit.
  double earliest = 1e300;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    const BadPixels bad({.late_dead_per_hour = 1e-9}, seed, "clip", kFrameRate, 640, 512);
    for (const BadPixels::LateDead& late : bad.late_dead()) earliest = std::min(earliest, late.frame);
  }
  CHECK(earliest > 0);
}

}  // namespace bad_pixels_test
