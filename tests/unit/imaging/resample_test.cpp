#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "imaging/sampling.h"
#include "support/catch.h"

namespace resample_test {

using namespace thermal;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr LensDistortion kLens = {.k1 = -0.3, .k2 = 0.1, .p1 = 0.004, .p2 = -0.003};
constexpr CameraIntrinsics kCamera = {
    .width_px = 64, .height_px = 48, .fx_px = 60, .fy_px = 61, .cx_px = 31, .cy_px = 25};

/// Position of the picture's pixel in the wide plane, in units of pixel centres: that of its first pixel is (0, 0).
LensPoint source_px(int x, int y, int overscan) {
  const LensPoint seen = undistort(
      kLens, {(x + 0.5 - kCamera.cx_px) / kCamera.fx_px, (y + 0.5 - kCamera.cy_px) / kCamera.fy_px});
  return {.x = kCamera.cx_px + kCamera.fx_px * seen.x - 0.5 + overscan,
          .y = kCamera.cy_px + kCamera.fy_px * seen.y - 0.5 + overscan};
}

/// A map for the lens with two pixels more than it needs, and planes of matching size.
struct Lens {
  int overscan = overscan_px(kCamera, kLens) + 2;
  ResampleMap map = ResampleMap(kCamera, overscan, kLens);
  int width = kCamera.width_px + 2 * overscan;
  int height = kCamera.height_px + 2 * overscan;
};

Plane<float> linear(const ResampleMap& map, const Plane<float>& in) {
  Plane<float> out;
  map.resample_linear(in, out);
  return out;
}

}  // namespace

TEST_CASE("Without distortion the picture is cropped from the centre, whatever surrounds it") {
  const CameraIntrinsics camera = {
      .width_px = 3, .height_px = 2, .fx_px = 5, .fy_px = 5, .cx_px = 1.5, .cy_px = 1};
  const ResampleMap map(camera, 2, {});
  Plane<float> radiance(7, 6, kNaN);
  Plane<std::uint16_t> indices(7, 6, 9);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      radiance.at(2 + x, 2 + y) = static_cast<float>(10 * y + x);
      indices.at(2 + x, 2 + y) = static_cast<std::uint16_t>(10 * y + x);
    }
  }
  const Plane<float> out = linear(map, radiance);
  const Plane<std::uint16_t> nearest = map.resample_nearest(indices);
  REQUIRE((out.width_px() == 3 && out.height_px() == 2));
  REQUIRE((nearest.width_px() == 3 && nearest.height_px() == 2));
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      CHECK(out.at(x, y) == static_cast<float>(10 * y + x));
      CHECK(nearest.at(x, y) == 10 * y + x);
    }
  }
}

TEST_CASE("In a linear plane each pixel has the value of its source position") {
  const Lens lens;
  Plane<float> ramp(lens.width, lens.height);
  for (int y = 0; y < lens.height; ++y) {
    for (int x = 0; x < lens.width; ++x)
      ramp.at(x, y) = 1 + 2 * static_cast<float>(x) - static_cast<float>(y);
  }
  const Plane<float> out = linear(lens.map, ramp);
  for (int y = 0; y < kCamera.height_px; ++y) {
    for (int x = 0; x < kCamera.width_px; ++x) {
      const LensPoint source = source_px(x, y, lens.overscan);
      // Values below 256 and differences below 2: shares and sums are rounded to 6e-8 of those, 2 + 2 times.
      const double tolerance = 4 * 6e-8 * 256;
      CHECK_THAT(static_cast<double>(out.at(x, y)), WithinAbs(1 + 2 * source.x - source.y, tolerance));
    }
  }
}

TEST_CASE("A uniform plane stays uniform to the last bit") {
  const Lens lens;
  const Plane<float> out = linear(lens.map, Plane<float>(lens.width, lens.height, 0.1F));
  CHECK(out == Plane<float>(kCamera.width_px, kCamera.height_px, 0.1F));
}

TEST_CASE("An index is that of the nearest pixel") {
  const Lens lens;
  Plane<std::uint16_t> numbered(lens.width, lens.height);
  for (std::size_t i = 0; i < numbered.size(); ++i) numbered.pixels()[i] = static_cast<std::uint16_t>(i);
  const Plane<std::uint16_t> out = lens.map.resample_nearest(numbered);
  for (int y = 0; y < kCamera.height_px; ++y) {
    for (int x = 0; x < kCamera.width_px; ++x) {
      const LensPoint source = source_px(x, y, lens.overscan);
      // Within the rounding of a fraction to single precision, either neighbour is correct; none is so close here.
      REQUIRE(std::abs(source.x - std::floor(source.x) - 0.5) > 1e-7);
      REQUIRE(std::abs(source.y - std::floor(source.y) - 0.5) > 1e-7);
      const auto nearest =
          static_cast<int>(std::lround(source.y)) * lens.width + static_cast<int>(std::lround(source.x));
      CHECK(out.at(x, y) == nearest);
    }
  }
}

TEST_CASE("Values that are not finite affect only pixels that use them") {
  const Lens lens;
  const int x_bad = lens.width / 3;
  const int y_bad = lens.height / 3;
  for (const float bad : {kNaN, std::numeric_limits<float>::infinity()}) {
    Plane<float> plane(lens.width, lens.height, 1);
    plane.at(x_bad, y_bad) = bad;
    const Plane<float> out = linear(lens.map, plane);
    int touched = 0;
    for (int y = 0; y < kCamera.height_px; ++y) {
      for (int x = 0; x < kCamera.width_px; ++x) {
        const LensPoint source = source_px(x, y, lens.overscan);
        const bool looks = std::abs(source.x - x_bad) < 1 && std::abs(source.y - y_bad) < 1;
        CHECK(std::isfinite(out.at(x, y)) == !looks);
        touched += looks ? 1 : 0;
      }
    }
    CHECK(touched > 0);
  }
}

TEST_CASE("The bits do not depend on the number of threads") {
  const auto run = [] {
    const Lens lens;
    Plane<float> plane(lens.width, lens.height);
    for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = std::sin(static_cast<float>(i));
    return linear(lens.map, plane);
  };
  CHECK(with_threads(1, run) == with_threads(4, run));
}

TEST_CASE("A picture of one pixel has no neighbours to interpolate with") {
  const CameraIntrinsics camera = {
      .width_px = 1, .height_px = 1, .fx_px = 1, .fy_px = 1, .cx_px = 0.5, .cy_px = 0.5};
  REQUIRE(overscan_px(camera, kLens) == 0);
  const ResampleMap map(camera, 0, kLens);
  CHECK(linear(map, Plane<float>(1, 1, 3)).at(0, 0) == 3);
  CHECK(map.resample_nearest(Plane<std::uint16_t>(1, 1, 3)).at(0, 0) == 3);
}

TEST_CASE("The counts match how often resample_nearest uses each pixel") {
  const Lens lens;
  const Plane<std::uint16_t> times = lens.map.times_shown();
  REQUIRE((times.width_px() == lens.width && times.height_px() == lens.height));
  int all = 0;
  for (int i = 0; i < 200; ++i) {  // some pixels, one by one
    const int x = (37 * i) % lens.width;
    const int y = (53 * i) % lens.height;
    Plane<std::uint16_t> one(lens.width, lens.height);
    one.at(x, y) = 1;
    int shown = 0;
    const Plane<std::uint16_t> picture = lens.map.resample_nearest(one);
    for (const std::uint16_t index : picture.pixels()) shown += index;
    CHECK(times.at(x, y) == shown);
    all += shown;
  }
  CHECK(all > 100);
  int sum = 0;
  for (const std::uint16_t count : times.pixels()) sum += count;
  CHECK(sum == 64 * 48);  // each pixel of the picture uses one
}

TEST_CASE("A crop uses each of its pixels once") {
  const CameraIntrinsics camera = {
      .width_px = 3, .height_px = 2, .fx_px = 5, .fy_px = 5, .cx_px = 1.5, .cy_px = 1};
  const Plane<std::uint16_t> times = ResampleMap(camera, 2, {}).times_shown();
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 7; ++x) CHECK(times.at(x, y) == (x >= 2 && x < 5 && y >= 2 && y < 4 ? 1 : 0));
  }
}

}  // namespace resample_test
