#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/cameras.h"
#include "support/catch.h"

namespace camera_edges_test {

using namespace thermal;
using cameras::camera;
using cameras::full_sensor;
using cameras::perfect_sensor;
using cameras::uniform_scene;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

AgcMode any_mode() {
  return GENERATE(AgcMode::scene_max, AgcMode::table_max, AgcMode::linear, AgcMode::percentile,
                  AgcMode::plateau);
}

SensorFrame frame_of(const SensorParameters& parameters, const Plane<float>& scene) {
  return camera(parameters, {.width_px = scene.width_px(), .height_px = scene.height_px()}).expose(scene);
}

/// A full sensor without memory: only noise carries over from frame to frame.
SensorParameters forgetful_sensor() {
  SensorParameters parameters = full_sensor();
  parameters.time_constant_s = 0;
  parameters.shutter.interval_s = 0;
  parameters.noise.first_frame_ratio = 0;
  parameters.agc.mode = AgcMode::linear;
  return parameters;
}

}  // namespace

TEST_CASE("Invalid radiances are shown as documented") {
  Plane<float> scene(6, 1);
  const std::vector<float> radiances = {kNan, 0, -1, -kInfinity, kInfinity, 1e30F};
  std::copy(radiances.begin(), radiances.end(), scene.pixels().begin());
  SensorParameters parameters = perfect_sensor();
  parameters.agc.mode = any_mode();
  const bool white = GENERATE(true, false);
  parameters.agc.polarity = white ? Polarity::white_hot : Polarity::black_hot;
  const SensorFrame frame = frame_of(parameters, scene);
  for (int x = 0; x < 6; ++x) {
    CAPTURE(x, white);
    CHECK(frame.ir16.at(x, 0) == (x < 4 ? 0 : 65535));
    CHECK(frame.ir8.at(x, 0) == ((x < 4) == white ? 0 : 255));
  }
}

TEST_CASE("16-bit counts are clipped where 16 bits end") {
  Plane<float> scene(3, 1, cameras::radiance_at(655.30));
  scene.at(1, 0) = cameras::radiance_at(655.36);
  scene.at(2, 0) = cameras::radiance_at(1000);
  const SensorFrame frame = frame_of(perfect_sensor(), scene);
  CHECK(frame.ir16.at(0, 0) == 65530);
  CHECK(frame.ir16.at(1, 0) == 65535);
  CHECK(frame.ir16.at(2, 0) == 65535);
}

TEST_CASE("Pixels saturate at the camera's temperature, where it states one") {
  Plane<float> scene(3, 1, cameras::radiance_at(413.0));
  scene.at(1, 0) = cameras::radiance_at(414.0);
  scene.at(2, 0) = cameras::radiance_at(1000);
  SensorParameters parameters = perfect_sensor();
  parameters.saturation_k = 413.15;
  const SensorFrame frame = frame_of(parameters, scene);
  CHECK(frame.ir16.at(0, 0) == 41300);
  CHECK(frame.ir16.at(1, 0) == 41315);
  CHECK(frame.ir16.at(2, 0) == 41315);
}

TEST_CASE("A pixel that is NaN counts as dark, in sharp and in blurred pictures") {
  SensorParameters parameters = perfect_sensor();
  parameters.optics.blur_sigma_px = GENERATE(0.0, 1.0);
  Plane<float> scene = uniform_scene(20, 15, 290);
  scene.at(7, 7) = 0;
  const SensorFrame dark = frame_of(parameters, scene);
  scene.at(7, 7) = GENERATE(as<float>{}, kNan, -5.0F, -kInfinity);
  CHECK(cameras::same_pixels(frame_of(parameters, scene), dark));
}

TEST_CASE("A frame of invalid radiances leaves no trace") {
  const float value = GENERATE(as<float>{}, kNan, -kInfinity, kInfinity);
  ThermalCamera struck = camera(forgetful_sensor(), {.width_px = 33, .height_px = 21});
  ThermalCamera spared = camera(forgetful_sensor(), {.width_px = 33, .height_px = 21});
  for (int frame = 0; frame < 6; ++frame) {
    Plane<float> scene = uniform_scene(33, 21, 290);
    const SensorFrame expected = spared.expose(scene);
    if (frame % 3 == 1) scene = Plane<float>(33, 21, value);
    const SensorFrame shown = struck.expose(scene);
    CHECK(cameras::same_pixels(shown, expected) == (frame % 3 != 1));
  }
}

TEST_CASE("A lagging pixel recovers from invalid values as from any flash or darkness") {
  SensorParameters parameters = perfect_sensor();
  parameters.time_constant_s = 0.012;
  const float value = GENERATE(as<float>{}, kNan, kInfinity);
  ThermalCamera sensor = camera(parameters, {.width_px = 5, .height_px = 3, .frame_rate_hz = 30});
  (void)sensor.expose(uniform_scene(5, 3, 290));
  (void)sensor.expose(Plane<float>(5, 3, value));
  // Full scale is 655.36 K, some 50 times the radiance of 290 K; after 12 frames e^-33 of it is left.
  SensorFrame frame;
  for (int i = 0; i < 12; ++i) sensor.expose(uniform_scene(5, 3, 290), frame);
  CHECK(frame.ir16 == Plane<std::uint16_t>(5, 3, 29000));
}

TEST_CASE("Empty and uniform scenes pass through every mode") {
  SensorParameters parameters = perfect_sensor();
  parameters.agc.mode = any_mode();
  const auto [side_px, nothing, white] = GENERATE(
      table<int, float, bool>({{1, 0.0F, true}, {1, kNan, false}, {9, kNan, true}, {9, 0.0F, false}}));
  parameters.agc.polarity = white ? Polarity::white_hot : Polarity::black_hot;
  ThermalCamera sensor = camera(parameters, {.width_px = side_px, .height_px = side_px});
  const SensorFrame dark = sensor.expose(Plane<float>(side_px, side_px, nothing));
  CHECK(dark.ir16 == Plane<std::uint16_t>(side_px, side_px, 0));
  CHECK(dark.ir8 == Plane<std::uint8_t>(side_px, side_px, white ? 0 : 255));
  const SensorFrame grey = sensor.expose(uniform_scene(side_px, side_px, 288));
  CHECK(grey.ir16 == Plane<std::uint16_t>(side_px, side_px, 28800));
  // linear: half of 263 to 313 K. Adaptive: the middle, within the 8 levels by which a plateau's bin may rise.
  const AgcMode mode = parameters.agc.mode;
  const bool of_radiance = mode == AgcMode::scene_max || mode == AgcMode::table_max;
  const double level = of_radiance ? static_cast<double>(cameras::radiance_at(288) / cameras::kLevel) : 127.5;
  const double shown = white ? grey.ir8.at(0, 0) : 255 - grey.ir8.at(0, 0);
  CHECK_THAT(shown, WithinAbs(level, mode == AgcMode::plateau ? 8.5 : 1));
}

TEST_CASE("An adaptive mode keeps its curve through empty frames") {
  SensorParameters parameters = perfect_sensor();
  parameters.agc.mode = GENERATE(AgcMode::percentile, AgcMode::plateau);
  ThermalCamera sensor = camera(parameters, {.width_px = 9, .height_px = 7});
  const ToneCurve curve = sensor.expose(uniform_scene(9, 7, 288)).curve;
  CHECK(sensor.expose(Plane<float>(9, 7, 0)).curve == curve);
  CHECK(sensor.expose(Plane<float>(9, 7, kInfinity)).curve == curve);
  CHECK(sensor.expose(uniform_scene(9, 7, 288)).curve == curve);
  CHECK_FALSE(sensor.expose(uniform_scene(9, 7, 298)).curve == curve);
}

TEST_CASE("Pictures of any size pass through every stage of a camera") {
  const auto [width_px, height_px] =
      GENERATE(table<int, int>({{1, 1}, {1, 37}, {37, 1}, {2, 2}, {255, 3}, {257, 2}, {63, 5}}));
  ThermalCamera sensor = camera(full_sensor(), {.width_px = width_px, .height_px = height_px});
  for (int i = 0; i < 12; ++i) {
    const SensorFrame frame = sensor.expose(uniform_scene(width_px, height_px, 290));
    REQUIRE(frame.ir16.width_px() == width_px);
    REQUIRE(frame.ir8.height_px() == height_px);
    for (const std::uint16_t count : frame.ir16.pixels()) {
      // All parts of the noise together have a deviation below 10 NETDs, blinking pixels 20: 0.8 K; a single dead
      // pixel has no neighbours and is dark.
      REQUIRE((count == 0 || std::abs(count - 29000) < 500));
    }
  }
}

}  // namespace camera_edges_test
