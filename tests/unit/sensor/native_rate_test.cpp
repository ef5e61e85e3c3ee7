#include <algorithm>
#include <vector>

#include "sensor/shutter.h"
#include "sensor/thermal_camera.h"
#include "support/cameras.h"
#include "support/catch.h"

namespace native_rate_test {

using namespace thermal;

namespace {

constexpr double kNativeHz = 60;

/// Every effect at once, a shutter that closes often, and a gain control that has no memory.
SensorParameters sensor() {
  SensorParameters parameters = cameras::full_sensor();
  parameters.native_rate_hz = kNativeHz;
  parameters.noise.banding_hz = 0.7;
  parameters.shutter = {.interval_s = 0.83, .freeze_s = 0.21};
  parameters.bad_pixels.blinking_share = 0.3;
  parameters.agc.mode = AgcMode::linear;
  return parameters;
}

cameras::ClipOf clip(double frame_rate_hz, const char* id) {
  return {.width_px = 61, .height_px = 43, .id = id, .frame_rate_hz = frame_rate_hz};
}

/// A scene of two halves.
Plane<float> still_scene() {
  Plane<float> scene = cameras::uniform_scene(61, 43, 290);
  for (int y = 0; y < 43; ++y) {
    for (int x = 20; x < 40; ++x) scene.at(x, y) = cameras::radiance_at(305);
  }
  return scene;
}

}  // namespace

TEST_CASE("A video shows every n-th native frame, the nearest number") {
  const auto [native_hz, video_hz, step, rate_hz] =
      GENERATE(table<double, double, std::uint32_t, double>({{0, 9, 1, 9},
                                                             {60, 60, 1, 60},
                                                             {60, 30, 2, 60},
                                                             {60, 9, 7, 63},
                                                             {60, 50, 1, 50},
                                                             {60, 100, 1, 100},
                                                             {60, 60.0 / 7, 7, 60},
                                                             {29.97, 29.97 / 11, 11, 29.97}}));
  const NativeRate native = NativeRate::of(native_hz, video_hz);
  CAPTURE(native_hz, video_hz);
  CHECK(native.step == step);
  CHECK(native.rate_hz == rate_hz);
}

TEST_CASE("The first frame of an event is the first whose shutter state has it") {
  const double rate_hz = GENERATE(9.0, 59.94, 60.0);
  const Shutter shutter({.interval_s = 0.7, .freeze_s = 0.1}, 3, "a");
  for (std::uint32_t event = 0; event < 50; ++event) {
    const std::uint32_t first = shutter.first_frame(event, rate_hz);
    CAPTURE(rate_hz, event, first);
    CHECK(shutter.at(first / rate_hz).event == event);
    if (first > 0) CHECK(shutter.at((first - 1) / rate_hz).event == event - 1);
  }
}

TEST_CASE("Of a still scene, a slower video is every n-th frame of the native one, bit for bit") {
  const std::uint32_t step = GENERATE(2U, 7U, 13U, 60U);
  const char* id = GENERATE("a", "b", "c");
  const Plane<float> scene = still_scene();
  ThermalCamera native = cameras::camera(sensor(), clip(kNativeHz, id));
  ThermalCamera video = cameras::camera(sensor(), clip(kNativeHz / step, id));
  SensorFrame expected;
  int closed = 0;
  for (std::uint32_t frame = 0; frame < 400; ++frame) {
    native.expose(scene, expected);
    if (frame % step != 0) continue;
    const SensorFrame found = video.expose(scene);
    CAPTURE(step, id, frame);
    REQUIRE(found.ir16 == expected.ir16);
    REQUIRE(found.shutter_closed == expected.shutter_closed);
    closed += found.shutter_closed ? 1 : 0;
  }
  CHECK((closed > 0 || step == 60));
  CHECK(native.noise_w_m2_sr(0, 0) == video.noise_w_m2_sr(0, 0));
}

TEST_CASE("Frames that are skipped do not change those after them") {
  const std::vector<int> skipped = {0, 1, 4, 9, 10, 11, 12, 30};
  const Plane<float> scene = still_scene();
  ThermalCamera all = cameras::camera(sensor(), clip(20, "a"));
  ThermalCamera some = cameras::camera(sensor(), clip(20, "a"));
  for (int frame = 0; frame < 50; ++frame) {
    const SensorFrame expected = all.expose(scene);
    CAPTURE(frame);
    if (std::ranges::find(skipped, frame) != skipped.end()) {
      some.skip();
    } else {
      REQUIRE(some.expose(scene).ir16 == expected.ir16);
    }
  }
}

TEST_CASE("Without a native rate, the video's frames are the sensor's") {
  SensorParameters without = sensor();
  without.native_rate_hz = 0;
  ThermalCamera one = cameras::camera(without, clip(kNativeHz, "a"));
  ThermalCamera same = cameras::camera(sensor(), clip(kNativeHz, "a"));
  for (int frame = 0; frame < 20; ++frame)
    REQUIRE(cameras::same_pixels(one.expose(still_scene()), same.expose(still_scene())));
}

}  // namespace native_rate_test
