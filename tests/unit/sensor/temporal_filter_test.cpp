#include <cmath>

#include "base/parallel.h"
#include "base/rng.h"
#include "sensor/processing.h"
#include "support/cameras.h"
#include "support/catch.h"

namespace temporal_filter_test {

using namespace thermal;

namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr float kNoise = 0.02F;

Plane<float> frame(std::uint32_t number, float radiance) {
  Plane<float> signal(kWidth, kHeight);
  fill_normal({.seed = 3, .stream = 1, .clip = 1, .frame = number}, 0, signal.pixels());
  for (float& value : signal.pixels()) value = radiance + kNoise * value;
  return signal;
}

double variance(const Plane<float>& signal, double mean) {
  double sum = 0;
  for (const float value : signal.pixels()) sum += std::pow(static_cast<double>(value) - mean, 2);
  return sum / static_cast<double>(signal.size());
}

}  // namespace

TEST_CASE("White noise of a still scene keeps share / (2 - share) of its variance") {
  const double share = GENERATE(0.1, 0.3, 0.5, 0.8);
  CAPTURE(share);
  TemporalFilter filter({.share_of_new = share, .motion_sigma = 6}, kNoise);
  Plane<float> signal;
  for (std::uint32_t number = 0; number < 120; ++number) {
    signal = frame(number, 40);
    filter.apply(signal);
  }
  const double kept = variance(signal, 40) / std::pow(static_cast<double>(kNoise), 2);
  // 19,200 pixels: a standard error of sqrt(2 / 19,200) = 1.0 %; four of them.
  CHECK_THAT(kept, WithinRel(share / (2 - share), 0.041));
}

TEST_CASE("A change of one pixel beyond the limit passes at once, a smaller one by its share") {
  TemporalFilter filter({.share_of_new = 0.25, .motion_sigma = 4}, kNoise);
  Plane<float> first(9, 5, 40);
  filter.apply(first);
  const float limit = 4 * kNoise * std::sqrt(2 / 1.75F);
  Plane<float> next(9, 5, 40);
  next.at(1, 2) += 1.01F * limit;
  next.at(7, 2) += 0.99F * limit;
  const Plane<float> given = next;
  filter.apply(next);
  CHECK(next.at(1, 2) == given.at(1, 2));
  CHECK(next.at(2, 2) == 40);
  CHECK_THAT(static_cast<double>(next.at(7, 2)),
             WithinAbs(40 + 0.25 * 0.99 * static_cast<double>(limit), 1e-5));
}

TEST_CASE(
    "A change of a neighbourhood passes at once if it is a third of a pixel's limit, up to the border") {
  const float share_of_limit = GENERATE(0.98F, 1.02F);
  TemporalFilter filter({.share_of_new = 0.25, .motion_sigma = 4}, kNoise);
  const float limit = 4 * kNoise * std::sqrt(2 / 1.75F);
  Plane<float> first(9, 5, 40);
  filter.apply(first);
  Plane<float> next(9, 5, 40 + share_of_limit * limit / 3);
  const Plane<float> given = next;
  filter.apply(next);
  for (std::size_t i = 0; i < next.size(); ++i)
    CHECK((next.pixels()[i] == given.pixels()[i]) == (share_of_limit > 1));
}

TEST_CASE("The first frame and the first after a restart pass unchanged, with any number of threads") {
  const auto filtered = [] {
    TemporalFilter filter({.share_of_new = 0.3}, kNoise);
    Plane<float> signal = frame(0, 40);
    filter.apply(signal);
    CHECK(signal == frame(0, 40));
    signal = frame(1, 40);
    filter.apply(signal);
    CHECK_FALSE(signal == frame(1, 40));
    filter.restart();
    signal = frame(2, 40);
    filter.apply(signal);
    CHECK(signal == frame(2, 40));
    signal = frame(3, 40);
    filter.apply(signal);
    return signal;
  };
  CHECK(with_threads(1, filtered) == with_threads(4, filtered));
}

TEST_CASE("Noise reduction acts on both outputs of a camera, and none leaves the same bits") {
  SensorParameters parameters = cameras::full_sensor();
  const auto exposed = [&](double share) {
    parameters.denoise.share_of_new = share;
    ThermalCamera camera = cameras::camera(parameters, {.width_px = 64, .height_px = 48});
    SensorFrame frame;
    for (int number = 0; number < 3; ++number) camera.expose(cameras::uniform_scene(64, 48, 300), frame);
    return frame;
  };
  const SensorFrame plain = exposed(1);
  const SensorFrame reduced = exposed(0.4);
  CHECK_FALSE(reduced.ir16 == plain.ir16);
  CHECK_FALSE(reduced.ir8 == plain.ir8);
}

}  // namespace temporal_filter_test
