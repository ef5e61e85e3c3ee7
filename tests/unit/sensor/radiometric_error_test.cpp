#include <cmath>

#include "sensor/shutter.h"
#include "support/cameras.h"
#include "support/catch.h"

namespace radiometric_error_test {

using namespace thermal;

TEST_CASE("A camera without a stated accuracy is exact") {
  const RadiometricError error(0, 1, "a");
  CHECK(error.at_k({}) == 0);
  CHECK(error.at_k({.event = 3, .since_intervals = 0.5}) == 0);
}

TEST_CASE("The error belongs to the clip, and its drift to each closing of the shutter") {
  const RadiometricError error(4, 1, "a");
  const double clip_k = error.at_k({});
  CHECK(clip_k != 0);
  CHECK(error.at_k({.event = 7}) == clip_k);
  const double grown_k = error.at_k({.event = 7, .since_intervals = 1}) - clip_k;
  CHECK(grown_k != 0);
  CHECK_THAT(error.at_k({.event = 7, .since_intervals = 0.25}) - clip_k,
             WithinRel((0.5 / 2 + 0.25 / 2) * grown_k, 1e-9));
  CHECK(error.at_k({.event = 8, .since_intervals = 1}) - clip_k != grown_k);
  CHECK(RadiometricError(4, 1, "a").at_k({}) == clip_k);
  CHECK_THAT(RadiometricError(2, 1, "a").at_k({}), WithinRel(clip_k / 2, 1e-12));
  CHECK(RadiometricError(4, 2, "a").at_k({}) != clip_k);
  CHECK(RadiometricError(4, 1, "b").at_k({}) != clip_k);
}

TEST_CASE("A camera adds its error to every temperature of the 16-bit picture, but not to darkness") {
  SensorParameters parameters = cameras::full_sensor();
  parameters.bad_pixels.replace_dead = false;
  parameters.shutter.freeze_s = 0;
  SensorParameters exact = parameters;
  parameters.accuracy_k = 4;
  const cameras::ClipOf clip = {.width_px = 40, .height_px = 30};
  ThermalCamera off = cameras::camera(parameters, clip);
  ThermalCamera right = cameras::camera(exact, clip);
  const Shutter shutter(parameters.shutter, clip.seed, clip.id);
  const RadiometricError error(4, clip.seed, clip.id);
  for (int frame = 0; frame < 20; ++frame) {
    const Plane<float> scene = cameras::uniform_scene(40, 30, 300);
    const SensorFrame found = off.expose(scene);
    const SensorFrame expected = right.expose(scene);
    const double error_counts = error.at_k(shutter.at(frame / 9.0)) / 0.01;
    for (std::size_t i = 0; i < found.ir16.size(); ++i) {
      if (expected.ir16.pixels()[i] == 0) {
        REQUIRE(found.ir16.pixels()[i] == 0);
      } else {
        REQUIRE(std::abs(found.ir16.pixels()[i] - expected.ir16.pixels()[i] - error_counts) <
                1.01);  // both rounded
      }
    }
  }
  CHECK(off.temperature_k(50) == right.temperature_k(50));
}

}  // namespace radiometric_error_test
