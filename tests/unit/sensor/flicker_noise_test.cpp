#include "sensor/flicker_noise.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/catch.h"

namespace flicker_noise_test {

using namespace thermal;

namespace {

constexpr std::size_t kPixels = 3001;  // not a multiple of a batch or a block

/// Every pixel's noise of a frame, made in pieces of this size.
std::vector<float> frame_of(FlickerNoise& noise, std::uint32_t frame, float stddev = 1,
                            std::size_t piece = kPixels, std::size_t pixels = kPixels) {
  std::vector<float> picture(pixels);
  for (std::size_t first = 0; first < pixels; first += piece) {
    noise.add(frame, first, stddev, std::span(picture).subspan(first, std::min(piece, pixels - first)));
  }
  return picture;
}

FlickerNoise noise_of(std::uint32_t seed, const char* clip, std::size_t pixels = kPixels) {
  return {seed, clip, FlickerDesign::fit(30, 0.5), pixels};
}

/// The density of white noise of variance 1 plus the 1/f noise, over that of the white noise alone.
double over_white(const FlickerDesign& design, double hz, double rate_hz, double knee_hz) {
  return 1 + knee_hz * design.density(hz, rate_hz) * rate_hz / 2;
}

}  // namespace

TEST_CASE("White and 1/f noise together have the spectrum 1 + knee / f within half a decibel") {
  const double rate_hz =
      GENERATE(9.0, 20.0, 25.0, 27.0, 30.0, 45.0, 50.0, 54.0, 60.0, 63.0, 72.0, 100.0, 120.0);
  const double knee_hz = GENERATE(0.01, 0.1, 0.2, 0.5, 1.0, 2.0, 20.0, 1000.0);
  const FlickerDesign design = FlickerDesign::fit(rate_hz, knee_hz);
  for (double hz = 3e-3; hz <= 0.5 * rate_hz; hz *= 1.02) {
    CAPTURE(rate_hz, knee_hz, hz);
    const double db = 10 * std::log10(over_white(design, hz, rate_hz, knee_hz) / (1 + knee_hz / hz));
    REQUIRE(std::abs(db) < 0.5);  // as documented for fit()
  }
}

TEST_CASE("1/f noise alone is within half a decibel where it is stronger than the white noise") {
  const double rate_hz = GENERATE(9.0, 30.0, 60.0, 63.0);
  const FlickerDesign design = FlickerDesign::fit(rate_hz, 0.5);
  for (double hz = 3e-3; hz <= 0.25; hz *= 1.02) {
    CAPTURE(rate_hz, hz);
    REQUIRE(std::abs(10 * std::log10(design.density(hz, rate_hz) * hz * rate_hz / 2)) < 0.75);
  }
}

TEST_CASE("The density is the transform of the autocorrelation, a straight line between ticks") {
  const FlickerProcess process = {.period_frames = 4, .keep = 0.6, .variance = 2};
  const FlickerDesign design = {.processes = {process}, .white_variance = 0.25};
  constexpr double kRate = 60;
  const auto correlation = [&](int lag) {
    const int ticks = lag / 4;
    const double between = lag / 4.0 - ticks;
    return std::pow(0.6, ticks) * (1 - between) + std::pow(0.6, ticks + 1) * between;
  };
  for (const double hz : {0.01, 1.0, 7.0, 14.9, 29.0, 30.0}) {
    double sum = 2 + 0.25;
    for (int lag = 1; lag < 400; ++lag)  // 0.6^100 is 6e-23
      sum += 4 * correlation(lag) * std::cos(2 * std::numbers::pi * hz / kRate * lag);
    CAPTURE(hz);
    CHECK_THAT(design.density(hz, kRate), WithinRel(2 / kRate * sum, 1e-9));
  }
}

TEST_CASE("The variance is the integral of the spectrum") {
  const double rate_hz = GENERATE(9.0, 60.0);
  const FlickerDesign design = FlickerDesign::fit(rate_hz, 0.5);
  double under = 0;
  constexpr int kSteps = 40000;  // midpoints in ln f, from far below the lowest corner to Nyquist
  const double low_hz = 1e-7;
  const double step = std::log(0.5 * rate_hz / low_hz) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double hz = low_hz * std::exp((i + 0.5) * step);
    under += design.density(hz, rate_hz) * hz * step;
  }
  // Steps of 0.05 % resolve the notches of the slowest process, 1/100 s wide, up to 20 Hz, where it has faded. Below
  // 1e-7 Hz lies 1e-7 / 1e-3 of a decade's share.
  CHECK_THAT(under, WithinRel(design.variance(), 2e-4));
}

TEST_CASE("Periods are powers of two, shorter than the time constant, and few ticks cost little") {
  for (const double rate_hz : {1e-3, 0.01, 1.0, 9.0, 60.0, 1000.0}) {
    const FlickerDesign design = FlickerDesign::fit(rate_hz, 0.5);
    double ticks = 0;
    std::uint32_t last = 1;
    for (const FlickerProcess& process : design.processes) {
      CAPTURE(rate_hz, process.period_frames);
      CHECK(std::has_single_bit(process.period_frames));
      CHECK(process.period_frames >= last);
      CHECK((process.keep > 0 && process.keep < 1));
      CHECK((process.keep > 0.44 || process.period_frames == 1));  // e^-0.8
      CHECK(process.variance > 0);
      last = process.period_frames;
      ticks += rate_hz / process.period_frames;
    }
    CHECK(ticks < 6.5);  // normals a pixel and second, at any rate
    CHECK(design.white_variance >= 0);
    CHECK(std::isfinite(design.variance()));
  }
}

TEST_CASE("1/f noise is the same every time, in one piece or in many") {
  FlickerNoise whole = noise_of(1, "a");
  FlickerNoise pieces = noise_of(1, "a");
  FlickerNoise tiny = noise_of(1, "a");
  for (std::uint32_t frame = 0; frame < 40; ++frame) {
    const std::vector<float> expected = frame_of(whole, frame);
    REQUIRE(frame_of(pieces, frame, 1, 1024) == expected);
    REQUIRE(frame_of(tiny, frame, 1, FlickerNoise::kBlockPixels) == expected);
  }
}

TEST_CASE("A frame of 1/f noise is the same whichever frames were asked for before") {
  const std::uint32_t step = GENERATE(2U, 7U, 60U, 999U);
  const std::uint32_t first = GENERATE(0U, 5U);
  FlickerNoise all = noise_of(1, "a");
  FlickerNoise some = noise_of(1, "a");
  for (FlickerNoise* noise : {&all, &some}) noise->restart_at(3, 2);
  for (std::uint32_t frame = 3; frame < 2000; ++frame) {
    const std::vector<float> expected = frame_of(all, frame);
    if (frame % step == first % step && frame >= first) REQUIRE(frame_of(some, frame) == expected);
  }
}

TEST_CASE("1/f noise differs by seed, clip, pixel and closing") {
  FlickerNoise noise = noise_of(1, "a");
  FlickerNoise other_seed = noise_of(2, "a");
  FlickerNoise other_clip = noise_of(1, "b");
  FlickerNoise other_event = noise_of(1, "a");
  other_event.restart_at(0, 1);
  const std::vector<float> first = frame_of(noise, 0);
  CHECK(frame_of(other_seed, 0) != first);
  CHECK(frame_of(other_clip, 0) != first);
  CHECK(frame_of(other_event, 0) != first);
  CHECK(frame_of(noise, 1) != first);
  CHECK(first[0] != first[kRandomBatch]);
}

TEST_CASE("In every frame a few blocks tick, and their pixels alone change") {
  constexpr std::size_t kMany = std::size_t{1} << 16;
  FlickerNoise noise = noise_of(1, "a", kMany);
  const FlickerDesign design = FlickerDesign::fit(30, 0.5);
  std::vector<float> before = frame_of(noise, 0, 1, kMany, kMany);
  for (std::uint32_t frame = 1; frame < 20; ++frame) {
    const std::vector<float> after = frame_of(noise, frame, 1, kMany, kMany);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < after.size(); i += FlickerNoise::kBlockPixels)
      changed += after[i] == before[i] ? 0U : 1U;
    const double expected = 256.0 / design.processes.front().period_frames;
    CAPTURE(frame, changed, expected);
    CHECK(std::abs(static_cast<double>(changed) - expected) < 5 * std::sqrt(expected));
    before = after;
  }
}

TEST_CASE("1/f noise continues from frame to frame whatever its amplitude was") {
  FlickerNoise steady = noise_of(1, "a");
  FlickerNoise muted = noise_of(1, "a");
  (void)frame_of(steady, 0);
  CHECK(frame_of(muted, 0, 0) == std::vector<float>(kPixels));
  CHECK(frame_of(steady, 1) == frame_of(muted, 1));
}

TEST_CASE("1/f noise is added to the existing values") {
  FlickerNoise noise = noise_of(1, "a", 5);
  FlickerNoise same = noise_of(1, "a", 5);
  std::vector<float> picture(5, 64);
  noise.add(0, 0, 2, picture);
  const std::vector<float> alone = frame_of(same, 0, 2, 5, 5);
  // A handful of sums near 64, each rounded to 4e-6.
  for (std::size_t i = 0; i < picture.size(); ++i) REQUIRE(std::abs(picture[i] - 64 - alone[i]) < 5e-5F);
}

}  // namespace flicker_noise_test
