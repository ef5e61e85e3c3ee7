#include "sensor/housing.h"

#include <cmath>
#include <vector>

#include "base/image.h"
#include "support/cameras.h"
#include "support/catch.h"

namespace housing_test {

using namespace thermal;

namespace {

constexpr int kWidth = 70;
constexpr int kHeight = 48;
constexpr double kHousing = 50;  // W m^-2 sr^-1, near 300 K
constexpr double kPerK = 0.7;

Housing housing_of(const HousingParameters& parameters, double amount = 1, std::uint32_t seed = 1,
                   const char* clip = "a") {
  return {parameters, amount, seed, clip, kWidth, kHeight, kHousing, kPerK};
}

/// A uniform scene through the housing, less that scene.
Plane<float> pattern_of(Housing& housing, float scene, const ShutterState& shutter = {}) {
  housing.begin_frame(shutter);
  Plane<float> picture(kWidth, kHeight, scene);
  housing.apply(0, picture.pixels());
  for (float& value : picture.pixels()) value -= scene;
  return picture;
}

double from_middle_px(int x, int y) { return std::hypot(x + 0.5 - 0.5 * kWidth, y + 0.5 - 0.5 * kHeight); }

}  // namespace

TEST_CASE(
    "A scene as warm as the housing shows no gain pattern, others one in proportion to the difference") {
  Housing housing = housing_of({.gain_error_share = 0.01});
  CHECK(pattern_of(housing, 50) == Plane<float>(kWidth, kHeight));
  const Plane<float> colder = pattern_of(housing, 30);
  const Plane<float> warmer = pattern_of(housing, 60);
  double largest = 0;
  for (std::size_t i = 0; i < colder.size(); ++i) {
    // Rounded to 4e-6 at 60 and at 30.
    REQUIRE_THAT(static_cast<double>(colder.pixels()[i]),
                 WithinAbs(-2 * static_cast<double>(warmer.pixels()[i]), 1e-5));
    largest = std::max(largest, std::abs(static_cast<double>(colder.pixels()[i])));
  }
  CHECK(largest > 0.2);  // 20 x 1 %
}

TEST_CASE("Gain errors stay for a clip, through closings of the shutter") {
  const HousingParameters parameters = {.gain_error_share = 0.01};
  Housing housing = housing_of(parameters);
  const Plane<float> before = pattern_of(housing, 30);
  CHECK(pattern_of(housing, 30, {.event = 3, .since_intervals = 0.7}) == before);
  Housing other_seed = housing_of(parameters, 1, 2);
  Housing other_clip = housing_of(parameters, 1, 1, "b");
  CHECK_FALSE(pattern_of(other_seed, 30) == before);
  CHECK_FALSE(pattern_of(other_clip, 30) == before);
}

TEST_CASE("The halo is round, 0 in the middle, and grows with the square of the distance to the corners") {
  Housing housing = housing_of({.halo_k = 0.1});
  const Plane<float> halo = pattern_of(housing, 0, {.event = 1, .since_intervals = 1});
  const double corner_px = std::hypot(0.5 * kWidth, 0.5 * kHeight);
  const double at_corner = static_cast<double>(halo.at(0, 0)) * std::pow(corner_px / from_middle_px(0, 0), 2);
  CHECK(std::abs(at_corner) > 1e-4 * kPerK);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      REQUIRE_THAT(
          static_cast<double>(halo.at(x, y)),
          WithinAbs(at_corner * std::pow(from_middle_px(x, y) / corner_px, 2), 1e-6 * std::abs(at_corner)));
    }
  }
}

TEST_CASE("The halo grows after a closing like the drift, and begins again with another size") {
  Housing housing = housing_of({.halo_k = 0.1});
  const auto corner = [&](std::uint32_t event, double since) {
    return static_cast<double>(pattern_of(housing, 0, {.event = event, .since_intervals = since}).at(0, 0));
  };
  CHECK(corner(1, 0) == 0);
  CHECK_THAT(corner(1, 0.25), WithinRel((0.5 / 2 + 0.25 / 2) * corner(1, 1), 1e-6));
  CHECK(corner(2, 0) == 0);
  CHECK(corner(2, 1) != corner(1, 1));
  Housing same = housing_of({.halo_k = 0.1});
  CHECK(static_cast<double>(pattern_of(same, 0, {.event = 2, .since_intervals = 1}).at(0, 0)) ==
        corner(2, 1));
}

TEST_CASE("Without a shutter there is no halo, and without parameters nothing") {
  Housing halo = housing_of({.halo_k = 1});
  CHECK(pattern_of(halo, 30, Shutter({}, 1, "a").at(5)) == Plane<float>(kWidth, kHeight));
  Housing none = housing_of({.excess_k = 20});
  CHECK(pattern_of(none, 30, {.event = 1, .since_intervals = 1}) == Plane<float>(kWidth, kHeight));
  CHECK_FALSE(none.has_gain());
}

TEST_CASE("The amount of noise is a factor on both patterns") {
  const HousingParameters parameters = {.gain_error_share = 0.01, .halo_k = 0.5};
  const ShutterState shutter = {.event = 1, .since_intervals = 1};
  Housing whole = housing_of(parameters);
  Housing half = housing_of(parameters, 0.5);
  Housing nothing = housing_of(parameters, 0);
  const Plane<float> one = pattern_of(whole, 30, shutter);
  const Plane<float> other = pattern_of(half, 30, shutter);
  for (std::size_t i = 0; i < one.size(); ++i)
    REQUIRE(std::abs(one.pixels()[i] - 2 * other.pixels()[i]) < 1e-5F);  // rounded at 30
  CHECK(pattern_of(nothing, 30, shutter) == Plane<float>(kWidth, kHeight));
}

TEST_CASE("The housing's patterns are the same in one piece or in many") {
  Housing housing = housing_of({.gain_error_share = 0.01, .halo_k = 0.5});
  housing.begin_frame({.event = 1, .since_intervals = 0.6});
  Plane<float> whole(kWidth, kHeight, 40);
  Plane<float> pieces = whole;
  housing.apply(0, whole.pixels());
  for (std::size_t first = 0; first < pieces.size(); first += 64)
    housing.apply(first, pieces.pixels().subspan(first, std::min<std::size_t>(64, pieces.size() - first)));
  CHECK(pieces == whole);
}

TEST_CASE("A camera's housing is warmer than the air, and its pixels' gains count as noise") {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.noise.amount = 1;
  parameters.netd_mk = 1e-3;
  parameters.kelvin_per_count = 0.005;
  parameters.housing = {.excess_k = 10, .gain_error_share = 0.02};
  const auto spread_k = [&](double air_k) {
    ThermalCamera camera(
        parameters, {.id = "a", .width_px = kWidth, .height_px = kHeight, .noise_gain = {}, .air_k = air_k},
        60);
    const SensorFrame frame = camera.expose(cameras::uniform_scene(kWidth, kHeight, 290));
    double squares = 0;
    for (const std::uint16_t count : frame.ir16.pixels()) squares += std::pow(0.005 * count - 290, 2);
    const BandRadiance band(parameters.response);
    const double difference = band.radiance(air_k + 10) - band.radiance(290);
    CHECK_THAT(camera.noise_w_m2_sr(0, 0), WithinRel(0.02 * std::sqrt(0.5) * difference, 1e-3));
    return std::sqrt(squares / (kWidth * kHeight));
  };
  // 0.02 x 20 K; its smooth half has 15 numbers a clip. Radiance is 17 % steeper in the middle of those 20 K.
  CHECK_THAT(spread_k(300), WithinRel(0.4 * 1.17, 0.5));
  ThermalCamera camera(
      parameters, {.id = "a", .width_px = kWidth, .height_px = kHeight, .noise_gain = {}, .air_k = 280}, 60);
  const SensorFrame frame = camera.expose(cameras::uniform_scene(kWidth, kHeight, 290));
  for (const std::uint16_t count : frame.ir16.pixels()) REQUIRE(std::abs(count - 58000) <= 1);
}

}  // namespace housing_test
