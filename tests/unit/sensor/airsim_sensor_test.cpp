#include "sensor/airsim_sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "radiometry/band_radiance.h"
#include "support/catch.h"

using namespace thermal;

namespace {

constexpr int kWidth = 80;
constexpr int kHeight = 60;
constexpr float kBrightest = 63.75F;  // a count is 0.25 W m^-2 sr^-1, exactly
constexpr float kCount = kBrightest / 255;

SensorParameters without_noise() {
  SensorParameters parameters;
  parameters.blur_sigma_px = 0;
  parameters.white_noise_stddev_dn = 0;
  parameters.flicker_noise_stddev_dn = 0;
  parameters.fixed_pattern_ratio = 0;
  return parameters;
}

AirsimSensor sensor_with(const SensorParameters& parameters, const std::string& clip = "a",
                         std::uint32_t seed = 1) {
  return AirsimSensor(parameters,
                      {.id = clip,
                       .seed = seed,
                       .frame_rate_hz = 9,
                       .width_px = kWidth,
                       .height_px = kHeight,
                       .noise_gain = {}},
                      kBrightest);
}

/// A scene of 100 counts on the left and 140 on the right: standard deviation 20.
Plane<float> two_halves() {
  Plane<float> scene(kWidth, kHeight, 100 * kCount);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kWidth / 2; x < kWidth; ++x) scene.at(x, y) = 140 * kCount;
  }
  return scene;
}

/// A frame one pixel high, a pixel for each radiance.
SensorFrame frame_of(const SensorParameters& parameters, const std::vector<float>& radiances) {
  Plane<float> scene(static_cast<int>(radiances.size()), 1);
  std::copy(radiances.begin(), radiances.end(), scene.pixels().begin());
  AirsimSensor sensor(parameters, {.id = "a", .width_px = scene.width_px(), .height_px = 1, .noise_gain = {}},
                      kBrightest);
  return sensor.expose(scene);
}

std::vector<int> ir8_of(const SensorParameters& parameters, const std::vector<float>& radiances) {
  const SensorFrame frame = frame_of(parameters, radiances);
  return {frame.ir8.pixels().begin(), frame.ir8.pixels().end()};
}

std::vector<int> ir16_of(const SensorParameters& parameters, const std::vector<float>& radiances) {
  const SensorFrame frame = frame_of(parameters, radiances);
  return {frame.ir16.pixels().begin(), frame.ir16.pixels().end()};
}

bool same_pixels(const SensorFrame& a, const SensorFrame& b) { return a.ir8 == b.ir8 && a.ir16 == b.ir16; }

}  // namespace

TEST_CASE("The paper's counts are rounded, the script's are cut off") {
  SensorParameters parameters = without_noise();
  const std::vector<float> radiances = {99.25F * kCount, 99.75F * kCount};
  parameters.normalisation = Normalisation::scene_max;
  CHECK(ir8_of(parameters, radiances) == std::vector<int>{99, 100});
  parameters.normalisation = Normalisation::table_max;
  CHECK(ir8_of(parameters, radiances) == std::vector<int>{99, 99});
}

TEST_CASE("Whole counts come out as they went in, by both ways") {
  SensorParameters parameters = without_noise();
  parameters.normalisation = GENERATE(Normalisation::scene_max, Normalisation::table_max);
  std::vector<int> counts(256);
  std::iota(counts.begin(), counts.end(), 0);
  std::vector<float> radiances;
  for (const int count : counts) radiances.push_back(static_cast<float>(count) * kCount);
  CHECK(ir8_of(parameters, radiances) == counts);
}

TEST_CASE("8-bit counts are clipped") {
  CHECK(ir8_of(without_noise(), {1.01F * kBrightest, 1e30F, -1}) == std::vector<int>{255, 255, 0});
}

TEST_CASE("A 16-bit count tells the apparent temperature to half a count") {
  const BandRadiance band(SpectralResponse::flat(8, 14));
  SensorParameters parameters = without_noise();
  parameters.kelvin_per_count = GENERATE(0.01, 0.1);
  std::vector<double> temperatures_k;
  std::vector<float> radiances;
  for (double temperature_k = 120; temperature_k < 640; temperature_k += 0.777) {
    temperatures_k.push_back(temperature_k);
    radiances.push_back(static_cast<float>(band.radiance(temperature_k)));
  }
  const std::vector<int> counts = ir16_of(parameters, radiances);
  // On top of half a count: the table, good to 1e-3 K (accuracy tests); radiance, signal and back are rounded to
  // single precision, 3 * 6e-8 of L, and L / L' <= 180 K at 640 K; so are temperature and count, 6e-8 of 640 K
  // each.
  const double bound_k = parameters.kelvin_per_count / 2 + 1e-3 + 3 * 6e-8 * 180 + 2 * 6e-8 * 640;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    REQUIRE_THAT(parameters.kelvin_per_count * counts[i], WithinAbs(temperatures_k[i], bound_k));
  }
}

TEST_CASE("16-bit counts are clipped where 16 bits end") {
  const BandRadiance band(SpectralResponse::flat(8, 14));
  SensorParameters parameters = without_noise();
  parameters.kelvin_per_count = 0.01;
  const std::vector<int> counts = ir16_of(
      parameters, {static_cast<float>(band.radiance(655.30)), static_cast<float>(band.radiance(656)), 1e30F});
  CHECK(counts == std::vector<int>{65530, 65535, 65535});
}

TEST_CASE("Radiances that cannot be are shown as said") {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> radiances = {std::numeric_limits<float>::quiet_NaN(), 0, -1, -kInfinity,
                                        kInfinity};
  CHECK(ir8_of(without_noise(), radiances) == std::vector<int>{0, 0, 0, 0, 255});
  CHECK(ir16_of(without_noise(), radiances) == std::vector<int>{0, 0, 0, 0, 65535});
}

TEST_CASE("One pixel that is NaN is dark and leaves its neighbours alone") {
  Plane<float> scene = two_halves();
  const SensorFrame whole = sensor_with(without_noise()).expose(scene);
  scene.at(7, 7) = std::numeric_limits<float>::quiet_NaN();
  SensorFrame holed = sensor_with(without_noise()).expose(scene);
  CHECK(holed.ir8.at(7, 7) == 0);
  CHECK(holed.ir16.at(7, 7) == 0);
  holed.ir8.at(7, 7) = whole.ir8.at(7, 7);
  holed.ir16.at(7, 7) = whole.ir16.at(7, 7);
  CHECK(same_pixels(holed, whole));
}

TEST_CASE("Frame n of a clip is the same in every run, also in one with other threads") {
  const auto frames_with = [](int threads) {
    const ThreadLimit limit(threads);
    AirsimSensor sensor = sensor_with(SensorParameters());
    std::vector<SensorFrame> frames;
    for (int frame = 0; frame < 4; ++frame) frames.push_back(sensor.expose(two_halves()));
    return frames;
  };
  const std::vector<SensorFrame> alone = frames_with(1);
  const std::vector<SensorFrame> again = frames_with(1);
  const std::vector<SensorFrame> together = frames_with(2);
  for (std::size_t frame = 0; frame < alone.size(); ++frame) {
    CAPTURE(frame);
    CHECK(same_pixels(alone[frame], again[frame]));
    CHECK(same_pixels(alone[frame], together[frame]));
  }
  CHECK_FALSE(same_pixels(alone[0], alone[1]));  // noise moves
}

TEST_CASE("Clips and seeds have noise of their own") {
  const Plane<float> scene = two_halves();
  const SensorFrame frame = sensor_with(SensorParameters(), "a", 1).expose(scene);
  CHECK(same_pixels(sensor_with(SensorParameters(), "a", 1).expose(scene), frame));
  CHECK_FALSE(same_pixels(sensor_with(SensorParameters(), "b", 1).expose(scene), frame));
  CHECK_FALSE(same_pixels(sensor_with(SensorParameters(), "a", 2).expose(scene), frame));
}

TEST_CASE("The fixed pattern is scaled by the first frame, and stays") {
  SensorParameters parameters = without_noise();
  parameters.normalisation = Normalisation::scene_max;
  parameters.fixed_pattern_ratio = 0.5;  // of 20 counts: a half width of 10
  AirsimSensor sensor = sensor_with(parameters);
  const SensorFrame first = sensor.expose(two_halves());
  const SensorFrame second = sensor.expose(Plane<float>(kWidth, kHeight, 120 * kCount));
  int most = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int pattern = second.ir8.at(x, y) - 120;
      REQUIRE(std::abs(pattern) <= 10);
      REQUIRE(first.ir8.at(x, y) - (x < kWidth / 2 ? 100 : 140) == pattern);
      most = std::max(most, std::abs(pattern));
    }
  }
  CHECK(most == 10);
}

TEST_CASE("Noise has the standard deviation asked for") {
  SensorParameters parameters = without_noise();
  SECTION("white") { parameters.white_noise_stddev_dn = 6; }
  SECTION("1/f") { parameters.flicker_noise_stddev_dn = 6; }
  const SensorFrame frame = sensor_with(parameters).expose(Plane<float>(kWidth, kHeight, 128 * kCount));
  constexpr int kPixels = kWidth * kHeight;
  double squares = 0;
  for (const int count : frame.ir8.pixels()) squares += (count - 128) * (count - 128);
  // Rounding to counts adds 1/12. The variance of n independent normals scatters by sqrt(2 / n): 5 sigma.
  CHECK_THAT(squares / kPixels, WithinRel(36 + 1.0 / 12, 5 * std::sqrt(2.0 / kPixels)));
}
