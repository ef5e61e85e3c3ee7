#include <algorithm>
#include <cmath>

#include "support/cameras.h"
#include "support/catch.h"

namespace lag_test {

using namespace thermal;

namespace {

constexpr int kFrames = 12;
constexpr double kWithin = 1e-6;  // of the larger of the two levels

/// The smallest radiance near 300 K that a camera without lag shows one count higher than the next smaller float.
struct Boundary {
  float radiance_w_m2_sr;
  std::uint16_t count;
};

Boundary find_boundary() {
  ThermalCamera camera = cameras::camera(cameras::perfect_sensor(), {.width_px = 1, .height_px = 1});
  const auto count_of = [&camera](float radiance) {
    return camera.expose(Plane<float>(1, 1, radiance)).ir16.at(0, 0);
  };
  float below = cameras::radiance_at(300);
  float above = cameras::radiance_at(300.01);
  const std::uint16_t count = count_of(above);
  REQUIRE(count == count_of(below) + 1);
  while (std::nextafter(below, above) < above) {
    const float middle = below + (above - below) / 2;
    (count_of(middle) == count ? above : below) = middle;
  }
  return {.radiance_w_m2_sr = above, .count = count};
}

/// Levels before and after a step that follow the exponential to `target` in the given frame after the step.
struct Step {
  double before;
  double after;
};

Step step_to(double target, double ratio, double left) {
  const double after = target / (1 + (ratio - 1) * left);  // target = after + (before - after) left
  return {.before = ratio * after, .after = after};
}

}  // namespace

TEST_CASE("A pixel follows a step exponentially, to 1e-6 of the larger level") {
  const double frame_rate_hz = GENERATE(9.0, 30.0, 60.0);
  const double time_constant_s = GENERATE(0.008, 0.012, 0.05);
  const double ratio = GENERATE(0.5, 2.0);  // up, down
  CAPTURE(frame_rate_hz, time_constant_s, ratio);
  // A 16-bit count is far coarser than 1e-6, but the transition from one count to the next is sharp. Pixel n is made
  // to reach that transition in frame n: in row 0 from 1e-6 below it, in row 1 from 1e-6 above.
  static const Boundary place = find_boundary();
  Plane<float> before(kFrames, 2);
  Plane<float> after(kFrames, 2);
  for (int n = 0; n < kFrames; ++n) {
    const double left = std::exp(-n / (frame_rate_hz * time_constant_s));
    for (int row = 0; row < 2; ++row) {
      const double exact = static_cast<double>(place.radiance_w_m2_sr);
      const double larger = exact * std::max(1.0, ratio) / (1 + (ratio - 1) * left);
      const Step step = step_to(exact + (row == 0 ? -kWithin : kWithin) * larger, ratio, left);
      before.at(n, row) = static_cast<float>(step.before);
      after.at(n, row) = static_cast<float>(step.after);
    }
  }
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.time_constant_s = time_constant_s;
  ThermalCamera camera =
      cameras::camera(parameters, {.width_px = kFrames, .height_px = 2, .frame_rate_hz = frame_rate_hz});
  for (int n = 0; n < kFrames; ++n) {
    CAPTURE(n);
    const SensorFrame frame = camera.expose(n == 0 ? before : after);
    CHECK(frame.ir16.at(n, 0) == place.count - 1);
    CHECK(frame.ir16.at(n, 1) == place.count);
  }
}

TEST_CASE("Without a time constant a pixel follows at once") {
  ThermalCamera camera = cameras::camera(cameras::perfect_sensor(), {.width_px = 3, .height_px = 2});
  (void)camera.expose(cameras::uniform_scene(3, 2, 280));
  CHECK(camera.expose(cameras::uniform_scene(3, 2, 310)).ir16 == Plane<std::uint16_t>(3, 2, 31000));
}

}  // namespace lag_test
