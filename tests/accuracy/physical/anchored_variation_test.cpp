#include "accuracy/physical/chain_scene.h"
#include "support/catch.h"

namespace anchored_variation_test {

using namespace thermal;

namespace {

constexpr int kSide = 32;
// Powers of two everywhere, so that the places of pixels are exact in single precision.
constexpr double kDepthM = 16;
constexpr double kFocalPx = 32;
constexpr double kPixelM = kDepthM / kFocalPx;

/// A camera that looks straight down on soil from a place, rotated about its axis by multiples of 90 degrees.
Plane<float> picture_from(double x_m, double y_m, int quarters) {
  constexpr std::array<std::array<double, 2>, 4> kTurns = {
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};  // cosine, sine
  const auto [c, s] = kTurns.at(static_cast<std::size_t>(quarters));
  Manifest manifest = chain_scene::manifest();
  manifest.camera = {kSide, kSide, kFocalPx, kFocalPx, kSide / 2.0, kSide / 2.0};
  manifest.frames[0].camera_to_world = {c, s, 0, x_m, s, -c, 0, y_m, 0, 0, -1, kDepthM, 0, 0, 0, 1};
  return chain_scene::radiance(
      {.variation = true},
      chain_scene::uniform_passes(kSide, kSide, chain_scene::kSoil, static_cast<float>(kDepthM), {0, 0, 1}),
      manifest);
}

}  // namespace

TEST_CASE("The same place on the ground has the same temperature in every frame, to the bit") {
  const Plane<float> here = picture_from(100, -40, 0);
  SECTION("from a camera that moved 5 pixels right and 3 up") {
    const Plane<float> there = picture_from(100 + 5 * kPixelM, -40 + 3 * kPixelM, 0);
    for (int y = 0; y + 3 < kSide; ++y) {
      for (int x = 5; x < kSide; ++x) REQUIRE(there.at(x - 5, y + 3) == here.at(x, y));
    }
  }
  SECTION("from a camera that turned by a right angle") {
    const Plane<float> turned = picture_from(100, -40, 1);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) REQUIRE(turned.at(kSide - 1 - y, x) == here.at(x, y));
    }
  }
}

TEST_CASE("Another place has another temperature, and another seed gives another field") {
  const Plane<float> here = picture_from(100, -40, 0);
  CHECK(here.at(0, 0) != here.at(kSide - 1, kSide - 1));
  CHECK(picture_from(60, -40, 0) != here);
}

}  // namespace anchored_variation_test
