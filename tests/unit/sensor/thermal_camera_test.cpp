#include "sensor/thermal_camera.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "sensor/optics/psf.h"
#include "support/cameras.h"
#include "support/catch.h"

namespace thermal_camera_test {

using namespace thermal;
using cameras::camera;
using cameras::full_sensor;
using cameras::kLevel;
using cameras::perfect_sensor;
using cameras::same_pixels;
using cameras::uniform_scene;

namespace {

constexpr int kWidth = 83;  // not a multiple of a vector or a block
constexpr int kHeight = 60;

cameras::ClipOf clip(const char* id = "a", std::uint32_t seed = 1) {
  return {.width_px = kWidth, .height_px = kHeight, .id = id, .seed = seed};
}

/// A scene of 100 levels on the left and 140 on the right, three quarters left.
Plane<float> two_parts() {
  Plane<float> scene(kWidth, kHeight, 100 * kLevel);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kWidth * 3 / 4; x < kWidth; ++x) scene.at(x, y) = 140 * kLevel;
  }
  return scene;
}

std::vector<SensorFrame> frames_of(const SensorParameters& parameters, const cameras::ClipOf& clip,
                                   int count) {
  ThermalCamera camera = cameras::camera(parameters, clip);
  std::vector<SensorFrame> frames;
  for (int frame = 0; frame < count; ++frame) frames.push_back(camera.expose(two_parts()));
  return frames;
}

std::vector<SensorFrame> frames_of(int count) {
  cameras::ClipOf large = clip();
  large.width_px = 301;  // several chunks of pixels
  large.height_px = 207;
  ThermalCamera camera = cameras::camera(full_sensor(), large);
  std::vector<SensorFrame> frames;
  for (int frame = 0; frame < count; ++frame) {
    frames.push_back(camera.expose(uniform_scene(301, 207, 280 + frame % 4)));
  }
  return frames;
}

std::vector<SensorFrame> frames_with(int threads, int count) {
  return with_threads(threads, [count] { return frames_of(count); });
}

bool same(const std::vector<SensorFrame>& a, const std::vector<SensorFrame>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const SensorFrame& one, const SensorFrame& other) {
                      return same_pixels(one, other) && one.curve == other.curve &&
                             one.shutter_closed == other.shutter_closed;
                    });
}

}  // namespace

TEST_CASE("A perfect camera shows whole levels exactly, in both of the paper's modes") {
  SensorParameters parameters = perfect_sensor();
  parameters.agc.mode = GENERATE(AgcMode::scene_max, AgcMode::table_max);
  Plane<float> scene(256, 1);
  for (int level = 0; level < 256; ++level) scene.at(level, 0) = static_cast<float>(level) * kLevel;
  const SensorFrame frame = camera(parameters, {.width_px = 256, .height_px = 1}).expose(scene);
  for (int level = 0; level < 256; ++level) CHECK(frame.ir8.at(level, 0) == level);
}

TEST_CASE("The paper's levels are rounded, the script's are truncated") {
  SensorParameters parameters = perfect_sensor();
  const bool script = GENERATE(false, true);
  parameters.agc.mode = script ? AgcMode::table_max : AgcMode::scene_max;
  Plane<float> scene(2, 1, 99.25F * kLevel);
  scene.at(1, 0) = 99.75F * kLevel;
  const SensorFrame frame = camera(parameters, {.width_px = 2, .height_px = 1}).expose(scene);
  CHECK(frame.ir8.at(0, 0) == 99);
  CHECK(frame.ir8.at(1, 0) == (script ? 99 : 100));
}

TEST_CASE("ir8 is the curve applied to ir16, in every mode but the script's, with all noise") {
  SensorParameters parameters = full_sensor();
  parameters.agc.mode = GENERATE(AgcMode::scene_max, AgcMode::table_max, AgcMode::linear, AgcMode::percentile,
                                 AgcMode::plateau);
  parameters.agc.polarity = GENERATE(Polarity::white_hot, Polarity::black_hot);
  for (const SensorFrame& frame : frames_of(parameters, clip(), 12)) {
    const auto& thresholds = frame.curve.thresholds;
    int wrong = 0;
    for (std::size_t i = 0; i < frame.ir16.size(); ++i) {
      const auto level =
          std::upper_bound(thresholds.begin(), thresholds.end(), frame.ir16.pixels()[i]) - thresholds.begin();
      const auto shown = parameters.agc.polarity == Polarity::black_hot ? 255 - level : level;
      const auto allowed = parameters.agc.mode == AgcMode::table_max ? 1 : 0;  // of radiance, not of counts
      wrong += std::abs(frame.ir8.pixels()[i] - shown) <= allowed ? 0 : 1;
    }
    REQUIRE(wrong == 0);
  }
}

TEST_CASE("Frame n of a clip is the same in every run, also in one with other threads") {
  const std::vector<SensorFrame> alone = frames_with(1, 12);
  CHECK(same(frames_with(1, 12), alone));
  CHECK(same(frames_with(2, 12), alone));
  CHECK(same(frames_with(0, 12), alone));
  CHECK_FALSE(same_pixels(alone[4], alone[8]));  // other noise, and the shutter open at least once
}

TEST_CASE("Clips share nothing: interleaved or one after the other, they are the same") {
  const std::vector<SensorFrame> a = frames_of(full_sensor(), clip("a"), 6);
  const std::vector<SensorFrame> b = frames_of(full_sensor(), clip("b"), 6);
  ThermalCamera one = camera(full_sensor(), clip("b"));
  ThermalCamera other = camera(full_sensor(), clip("a"));
  SensorFrame frame;  // one frame's memory for both
  for (std::size_t i = 0; i < a.size(); ++i) {
    one.expose(two_parts(), frame);
    REQUIRE(same_pixels(frame, b[i]));
    other.expose(two_parts(), frame);
    REQUIRE(same_pixels(frame, a[i]));
  }
  CHECK_FALSE(same_pixels(a[0], b[0]));
  CHECK_FALSE(same_pixels(a[0], frames_of(full_sensor(), clip("a", 2), 1)[0]));
}

TEST_CASE("White noise is a function of seed and clip") {
  SensorParameters parameters = perfect_sensor();
  parameters.noise.amount = 1;
  const SensorFrame frame = frames_of(parameters, clip("a", 1), 1)[0];
  CHECK(same_pixels(frames_of(parameters, clip("a", 1), 1)[0], frame));
  CHECK_FALSE(same_pixels(frames_of(parameters, clip("b", 1), 1)[0], frame));
  CHECK_FALSE(same_pixels(frames_of(parameters, clip("a", 2), 1)[0], frame));
}

TEST_CASE("A camera that receives means of samples leaves their part of the footprint out of its blur") {
  SensorParameters parameters = perfect_sensor();
  parameters.optics.psf = Psf::physical;
  const PixelSampling sampling =
      GENERATE(PixelSampling{1, false}, PixelSampling{2, false}, PixelSampling{4, true});
  SubpixelDetail detail;
  if (sampling.quarters) {
    detail = {.across = Plane<float>(kWidth, kHeight, 3 * kLevel),
              .down = Plane<float>(kWidth, kHeight),
              .crossed = Plane<float>(kWidth, kHeight)};
  }
  Plane<float> blurred = two_parts();
  Optics(parameters.optics, parameters.response, sampling).apply(detail, blurred);
  cameras::ClipOf sampled = clip();
  sampled.sampling = sampling;
  const SensorFrame expected = camera(perfect_sensor(), clip()).expose(blurred);
  SensorFrame frame;
  camera(parameters, sampled).expose(two_parts(), detail, {}, frame);
  CHECK(same_pixels(frame, expected));
}

TEST_CASE("The paper's fixed pattern is scaled by the first frame, and stays") {
  SensorParameters parameters = perfect_sensor();
  parameters.noise = {.amount = 0.5, .first_frame_ratio = 1};
  parameters.netd_mk = 1e-6;  // practically no white noise
  ThermalCamera sensor = camera(parameters, clip());
  // 62 columns of 100 levels and 21 of 140: standard deviation 40 sqrt(62 * 21) / 83.
  const double half_width = 0.5 * 40 * std::sqrt(62.0 * 21) / 83;
  const SensorFrame first = sensor.expose(two_parts());
  const SensorFrame second = sensor.expose(Plane<float>(kWidth, kHeight, 120 * kLevel));
  double most = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int pattern = second.ir8.at(x, y) - 120;
      REQUIRE(std::abs(pattern) <= half_width + 0.5);
      REQUIRE(std::abs(first.ir8.at(x, y) - (x < kWidth * 3 / 4 ? 100 : 140) - pattern) <=
              1);  // both rounded
      most = std::max<double>(most, std::abs(pattern));
    }
  }
  CHECK(most >= half_width - 1);
}

TEST_CASE("Noise has the standard deviation of its NETD, behind any lens and at the edge of the field") {
  SensorParameters parameters = perfect_sensor();
  parameters.noise.amount = GENERATE(1.0, 2.0);
  parameters.optics.f_number = 1.25;
  parameters.netd_mk = 40;
  Plane<float> gain(kWidth, kHeight, 1.5F);
  ThermalCamera sensor(parameters, {.id = "a", .width_px = kWidth, .height_px = kHeight, .noise_gain = gain},
                       60);
  const SensorFrame frame = sensor.expose(uniform_scene(kWidth, kHeight, 300));
  double squares_k2 = 0;
  for (const std::uint16_t count : frame.ir16.pixels()) squares_k2 += std::pow(0.01 * count - 300, 2);
  const double sigma_k = 0.040 * (7.25 / 5) * 1.5 * parameters.noise.amount;
  constexpr double kPixels = kWidth * kHeight;
  // Rounding to counts adds 1/12. The variance of n independent normals scatters by sqrt(2 / n): 5 sigma.
  CHECK_THAT(squares_k2 / kPixels, WithinRel(sigma_k * sigma_k + 1e-4 / 12, 5 * std::sqrt(2 / kPixels)));
}

TEST_CASE("The picture freezes when the shutter closes, to the frame, and time continues behind it") {
  const double frame_rate_hz = GENERATE(9.0, 30.0, 60.0);
  SensorParameters freezing = full_sensor();
  freezing.agc.mode = AgcMode::linear;  // an adaptive curve depends on earlier frames
  freezing.shutter = {.interval_s = 0.9, .freeze_s = 0.3};
  SensorParameters open = freezing;
  open.shutter.freeze_s = 0;
  cameras::ClipOf small = clip();
  small.width_px = 20;
  small.height_px = 14;
  small.frame_rate_hz = frame_rate_hz;
  const double begins_s = Shutter(freezing.shutter, small.seed, small.id).begins_s();
  ThermalCamera frozen_camera = camera(freezing, small);
  ThermalCamera open_camera = camera(open, small);
  SensorFrame last;
  int closed = 0;
  for (int frame = 0; frame < 10 * 0.9 * frame_rate_hz; ++frame) {
    CAPTURE(frame_rate_hz, frame);
    const Plane<float> scene = uniform_scene(20, 14, 280 + frame % 7);
    const SensorFrame shown = frozen_camera.expose(scene);
    const SensorFrame unfrozen = open_camera.expose(scene);
    const bool expected = std::fmod(begins_s + frame / frame_rate_hz, 0.9) < 0.3;
    REQUIRE(shown.shutter_closed == expected);
    REQUIRE_FALSE(unfrozen.shutter_closed);
    if (expected && frame > 0) REQUIRE((same_pixels(shown, last) && shown.curve == last.curve));
    if (!expected || frame == 0) REQUIRE(same_pixels(shown, unfrozen));
    if (expected && frame > 0) REQUIRE_FALSE(same_pixels(shown, unfrozen));
    closed += expected ? 1 : 0;
    last = shown;
  }
  CHECK(closed > 9 * 0.3 * frame_rate_hz - 10);
}

TEST_CASE("A blurred picture's mean is the scene's, and the blur is in radiance") {
  SensorParameters parameters = perfect_sensor();
  parameters.optics.blur_sigma_px = 1;
  const SensorFrame frame = camera(parameters, {.width_px = 21, .height_px = 1}).expose([] {
    Plane<float> line(21, 1, 100 * kLevel);
    line.at(10, 0) = 200 * kLevel;
    return line;
  }());
  const double share = static_cast<double>(gaussian_kernel(1)[0]);
  CHECK(frame.ir8.at(10, 0) == std::lround(100 + 100 * share));
  CHECK(frame.ir8.at(5, 0) == 100);
}

TEST_CASE("After a skipped first frame, all state of the camera starts with the next") {
  SensorParameters parameters = full_sensor();
  parameters.shutter = {};
  ThermalCamera late = camera(parameters, clip());
  late.skip();
  const SensorFrame first = late.expose(two_parts());
  const SensorFrame usual = frames_of(parameters, clip(), 1).front();
  // Another frame's noise, equally strong: standard deviations of 4980 differences agree to a few per cent.
  CHECK_FALSE(same_pixels(first, usual));
  const auto spread = [](const SensorFrame& frame) {
    double sum = 0;
    double squares = 0;
    int count = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth / 2; ++x, ++count) {
        sum += frame.ir16.at(x, y);
        squares += static_cast<double>(frame.ir16.at(x, y)) * frame.ir16.at(x, y);
      }
    }
    return std::sqrt(squares / count - sum / count * sum / count);
  };
  CHECK_THAT(spread(first), WithinRel(spread(usual), 0.15));
}

TEST_CASE("A lag has no history in the first frame that is given") {
  SensorParameters parameters = perfect_sensor();
  parameters.time_constant_s = 0.2;
  ThermalCamera late = camera(parameters, clip());
  late.skip();
  CHECK(same_pixels(late.expose(two_parts()), frames_of(perfect_sensor(), clip(), 1).front()));
}

TEST_CASE("A skipped frame's noise is not reused: later frames have the noise of their own numbers") {
  SensorParameters parameters = perfect_sensor();
  parameters.noise.amount = 1;
  ThermalCamera gap = camera(parameters, clip());
  (void)gap.expose(two_parts());
  gap.skip();
  CHECK(same_pixels(gap.expose(two_parts()), frames_of(parameters, clip(), 3).back()));
}

}  // namespace thermal_camera_test
