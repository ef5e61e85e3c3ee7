#include "imaging/target_contrast.h"

#include <cmath>

#include "support/cameras.h"
#include "support/catch.h"

namespace target_contrast_test {

using namespace thermal;

namespace {

constexpr int kSide = 21;

/// One actor of 3 x 3 px in the middle.
std::vector<Instance> one_actor() {
  Plane<std::uint16_t> plane(kSide, kSide);
  for (int y = 9; y < 12; ++y) {
    for (int x = 9; x < 12; ++x) plane.at(x, y) = 7;
  }
  const std::vector<std::uint16_t> actors = {7};
  return extract_instances(plane, survey_indices(plane), IndexSet(actors));
}

/// The actor at one temperature, everything else at another.
Plane<float> scene(double actor_k, double around_k) {
  Plane<float> radiance = cameras::uniform_scene(kSide, kSide, around_k);
  for (int y = 9; y < 12; ++y) {
    for (int x = 9; x < 12; ++x) radiance.at(x, y) = cameras::radiance_at(actor_k);
  }
  return radiance;
}

Instance seen(const SensorParameters& parameters, const Plane<float>& radiance, double gain = 0) {
  ThermalCamera::Clip clip = {.id = "a", .width_px = kSide, .height_px = kSide, .noise_gain = {}};
  if (gain > 0) clip.noise_gain = Plane<float>(kSide, kSide, 1);
  if (gain > 0) clip.noise_gain.at(10, 10) = static_cast<float>(gain);
  ThermalCamera camera(parameters, clip, 60);
  std::vector<Instance> instances = one_actor();
  SensorFrame frame;
  camera.expose(radiance, frame, [&](const Plane<float>& plane) { set_contrast(camera, plane, instances); });
  return instances.front();
}

}  // namespace

// Single precision of a radiance near 60 W m^-2 sr^-1 is 4e-6, and a kelvin is 0.6; a temperature near 300 K is
// accurate to 1.5e-5 K, and the table's own error is below 1e-4 K.
TEST_CASE("Contrast is as seen by a perfect camera, whatever its sign") {
  const Instance warm = seen(cameras::perfect_sensor(), scene(305, 285));
  CHECK_THAT(warm.temperature_k.value(), WithinAbs(305, 2e-4));
  CHECK_THAT(warm.contrast_k.value(), WithinAbs(20, 4e-4));
  CHECK_FALSE(warm.contrast_noise);  // there is none
  CHECK_THAT(seen(cameras::perfect_sensor(), scene(280, 285)).contrast_k.value(), WithinAbs(-5, 4e-4));
}

TEST_CASE("In units of the noise it is the difference of radiances / that of the noise") {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.noise.amount = 1;
  const double difference =
      static_cast<double>(cameras::radiance_at(300.4)) - static_cast<double>(cameras::radiance_at(300));
  const double noise = 0.04 * BandRadiance(parameters.response).evaluate(300).derivative_w_m2_sr_k;
  const double expected = difference / noise;  // near 10: 0.4 K of 40 mK
  CHECK_THAT(expected, WithinAbs(10, 0.1));
  CHECK_THAT(seen(parameters, scene(300.4, 300)).contrast_noise.value(), WithinRel(expected, 1e-5));
  CHECK_THAT(seen(parameters, scene(300.4, 300), 2).contrast_noise.value(), WithinRel(expected / 2, 1e-5));
}

TEST_CASE("Blur reduces the contrast of a small target") {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.optics.blur_sigma_px = 1;
  // A Gaussian of 1 px has the weights 0.399, 0.242 and 0.054 at 0, 1 and 2 px: the mean of three pixels in a row
  // keeps 0.399 + 4/3 x 0.242 + 2/3 x 0.054 = 0.758, that of three by three 0.574. Of 20 K that is 11.5 K, and
  // slightly more, because a mean of radiances is warmer than one of temperatures.
  const double contrast_k = seen(parameters, scene(305, 285)).contrast_k.value();
  CHECK(contrast_k > 11.45);
  CHECK(contrast_k < 12);
}

TEST_CASE("It is measured before lag, noise and bad pixels, and while the shutter is closed") {
  SensorParameters parameters = cameras::full_sensor();
  parameters.optics = cameras::perfect_sensor().optics;
  parameters.shutter = {.interval_s = 0.5, .freeze_s = 0.5};  // always closed
  ThermalCamera camera = cameras::camera(parameters, {.width_px = kSide, .height_px = kSide});
  SensorFrame frame;
  camera.expose(scene(285, 285), frame);
  std::vector<Instance> instances = one_actor();
  camera.expose(scene(305, 285), frame,
                [&](const Plane<float>& plane) { set_contrast(camera, plane, instances); });
  CHECK(frame.shutter_closed);
  CHECK_THAT(instances[0].contrast_k.value(), WithinAbs(20, 4e-4));
}

TEST_CASE("An actor without surroundings has a temperature and no contrast") {
  Plane<std::uint16_t> plane(3, 3, 7);
  const std::vector<std::uint16_t> actors = {7};
  std::vector<Instance> instances = extract_instances(plane, survey_indices(plane), IndexSet(actors));
  const ThermalCamera camera = cameras::camera(cameras::full_sensor(), {.width_px = 3, .height_px = 3});
  set_contrast(camera, cameras::uniform_scene(3, 3, 290), instances);
  CHECK_THAT(instances[0].temperature_k.value(), WithinAbs(290, 2e-4));
  CHECK_FALSE(instances[0].contrast_k);
  CHECK_FALSE(instances[0].contrast_noise);
}

}  // namespace target_contrast_test
