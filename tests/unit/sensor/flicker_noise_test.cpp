#include "sensor/flicker_noise.h"

#include <cmath>
#include <numeric>
#include <vector>

#include "support/catch.h"

namespace flicker_noise_test {

using namespace thermal;

namespace {

constexpr std::size_t kPixels = 3001;  // not a multiple of a batch or a block

/// Every pixel's noise of the next frame, made in pieces of this size.
std::vector<float> next_of(FlickerNoise& noise, std::uint32_t frame, float stddev = 1,
                           std::size_t piece = kPixels, std::size_t pixels = kPixels) {
  std::vector<float> picture(pixels);
  for (std::size_t first = 0; first < pixels; first += piece) {
    noise.add_next(frame, first, stddev, std::span(picture).subspan(first, std::min(piece, pixels - first)));
  }
  return picture;
}

FlickerNoise noise_of(std::uint32_t seed, const char* clip, std::size_t pixels = kPixels) {
  return {seed, clip, FlickerFilter::design(9), pixels};
}

/// Least-squares slope of ln(density) against ln(frequency), evenly spread points.
double slope(const FlickerFilter& filter, double frame_rate_hz, double low_hz, double high_hz) {
  constexpr int kPoints = 300;
  std::vector<double> x(kPoints);
  std::vector<double> y(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const auto place = static_cast<std::size_t>(i);
    const double frequency_hz = low_hz * std::pow(high_hz / low_hz, (i + 0.5) / kPoints);
    x[place] = std::log(frequency_hz);
    y[place] = std::log(filter.density(frequency_hz, frame_rate_hz));
  }
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / kPoints;
  double spread = 0;
  double rise = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    spread += (x[i] - mean_x) * (x[i] - mean_x);
    rise += (x[i] - mean_x) * y[i];
  }
  return rise / spread;
}

}  // namespace

TEST_CASE("The filter's spectrum is 1/f, as strong at 1 Hz as white noise of variance 1") {
  const double frame_rate_hz = GENERATE(5.0, 9.0, 20.0, 30.0, 60.0);
  const FlickerFilter filter = FlickerFilter::design(frame_rate_hz);
  for (double hz = 3e-3; hz <= 0.5 * frame_rate_hz; hz *= 1.05) {
    CAPTURE(frame_rate_hz, hz);
    const double level_db = 10 * std::log10(filter.density(hz, frame_rate_hz) * hz * frame_rate_hz / 2);
    REQUIRE(level_db > -0.5);  // as documented for design()
    REQUIRE(level_db < (hz < 0.35 * frame_rate_hz ? 0.5 : 0.8));
  }
}

TEST_CASE("The filter's slope is -1 within 0.005 over three decades") {
  CHECK_THAT(slope(FlickerFilter::design(60), 60, 0.01, 10), WithinAbs(-1, 0.005));
  CHECK_THAT(slope(FlickerFilter::design(30), 30, 0.01, 10), WithinAbs(-1, 0.005));
  CHECK_THAT(slope(FlickerFilter::design(60, 2), 60, 0.01, 10), WithinAbs(-1, 0.005));
}

TEST_CASE("The variance is the integral of the spectrum") {
  const double frame_rate_hz = GENERATE(9.0, 60.0);
  const FlickerFilter filter = FlickerFilter::design(frame_rate_hz);
  double under = 0;
  constexpr int kSteps = 4000;  // midpoints in ln f, from far below the lowest pole to Nyquist
  const double low_hz = 1e-7;
  const double step = std::log(0.5 * frame_rate_hz / low_hz) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double hz = low_hz * std::exp((i + 0.5) * step);
    under += filter.density(hz, frame_rate_hz) * hz * step;
  }
  // Midpoints 0.5 % apart: 1e-5. Below 1e-7 Hz lies 1e-7 / 1e-3 of a decade's share.
  CHECK_THAT(under, WithinRel(filter.variance(), 1e-4));
}

TEST_CASE("A filter of the lowest rates is valid too") {
  for (const double frame_rate_hz : {1e-3, 0.01, 1.0}) {
    const FlickerFilter filter = FlickerFilter::design(frame_rate_hz);
    CHECK(std::isfinite(filter.variance()));
    CHECK(filter.variance() > 0);
    for (const double pole : filter.poles) CHECK((pole > 0 && pole < 1));
  }
}

TEST_CASE("1/f noise is the same every time, in one piece or in many") {
  FlickerNoise whole = noise_of(1, "a");
  FlickerNoise pieces = noise_of(1, "a");
  FlickerNoise tiny = noise_of(1, "a");
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    const std::vector<float> expected = next_of(whole, frame);
    REQUIRE(next_of(pieces, frame, 1, 1024) == expected);
    REQUIRE(next_of(tiny, frame, 1, kRandomBatch) == expected);
  }
}

TEST_CASE("1/f noise differs by seed, clip and pixel") {
  FlickerNoise noise = noise_of(1, "a");
  FlickerNoise other_seed = noise_of(2, "a");
  FlickerNoise other_clip = noise_of(1, "b");
  const std::vector<float> first = next_of(noise, 0);
  CHECK(next_of(other_seed, 0) != first);
  CHECK(next_of(other_clip, 0) != first);
  CHECK(next_of(noise, 1) != first);
  CHECK(first[0] != first[kRandomBatch]);
}

TEST_CASE("1/f noise continues from frame to frame whatever its amplitude was") {
  FlickerNoise steady = noise_of(1, "a");
  FlickerNoise muted = noise_of(1, "a");
  (void)next_of(steady, 0);
  CHECK(next_of(muted, 0, 0) == std::vector<float>(kPixels));
  CHECK(next_of(steady, 1) == next_of(muted, 1));
}

TEST_CASE("1/f noise is added to the existing values") {
  FlickerNoise noise = noise_of(1, "a", 5);
  FlickerNoise same = noise_of(1, "a", 5);
  std::vector<float> picture(5, 64);
  noise.add_next(0, 0, 2, picture);
  const std::vector<float> alone = next_of(same, 0, 2, 5, 5);
  // A handful of sums near 64, each rounded to 4e-6.
  for (std::size_t i = 0; i < picture.size(); ++i) REQUIRE(std::abs(picture[i] - 64 - alone[i]) < 5e-5F);
}

}  // namespace flicker_noise_test
