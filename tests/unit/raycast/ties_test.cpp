#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "support/traced.h"

// Surfaces that are too close together for single precision: which one is first must be what double precision says, or
// else what the order of the pieces says, but never what a processor's rounding says.

namespace ties_test {

using namespace small_scene;

namespace {

constexpr int kWidthPx = 24;
constexpr int kHeightPx = 18;

/// A square of 80 m at z = 0, of triangles that are small and large by turns.
shapes::Shape square(std::uint32_t cells) {
  return shapes::field(80, cells, 1, [](double, double) { return 0; });
}

/// The objects that a camera sees that looks down from 100 m.
std::vector<std::uint16_t> seen_from_above(const Scenery& place, const std::vector<Matrix>& bones = {}) {
  Clip clip = {.camera_to_world = {looking({1, 2, 100}, {0, 0, 0})}, .poses = {}};
  if (!bones.empty()) clip.poses = {{bones}};
  const auto passes = traced(place, clip, pinhole(kWidthPx, kHeightPx, 60));
  const auto pixels = passes.object_index.pixels();
  return {pixels.begin(), pixels.end()};
}

std::ptrdiff_t count_of(const std::vector<std::uint16_t>& seen, std::uint16_t object) {
  return std::ranges::count(seen, object);
}

}  // namespace

TEST_CASE("Of two surfaces a micrometre apart, the nearer one is seen from 100 m") {
  const auto pixels = static_cast<std::ptrdiff_t>(kWidthPx) * kHeightPx;
  for (const auto& [lower, upper] : {std::pair{kTree, kShrub}, std::pair{kShrub, kTree}}) {
    for (const auto& [first_cells, second_cells] :
         {std::pair{1U, 7U}, std::pair{7U, 1U}, std::pair{3U, 3U}}) {
      Scenery place;
      place.plant(kTree, square(first_cells), upright(0, 0, lower == kTree ? -1e-6 : 1e-6));
      place.plant(kShrub, square(second_cells), upright(0, 0, lower == kShrub ? -1e-6 : 1e-6, 0.3));
      CHECK(count_of(seen_from_above(place), upper) == pixels);
    }
  }
}

TEST_CASE("Of two surfaces in the same place, each pixel shows the one that is listed first") {
  const auto pixels = static_cast<std::ptrdiff_t>(kWidthPx) * kHeightPx;
  for (const auto& [first, second] : {std::pair{kTree, kShrub}, std::pair{kShrub, kTree}}) {
    Scenery place;
    place.plant(first, square(3), kIdentity);
    place.plant(second, square(3), kIdentity);
    CHECK(count_of(seen_from_above(place), first) == pixels);
  }
}

TEST_CASE("An actor that lies in the ground's plane is seen") {
  const auto pixels = static_cast<std::ptrdiff_t>(kWidthPx) * kHeightPx;
  Scenery place;
  place.surface(kGround, square(3));
  place.actor({square(3)});
  CHECK(count_of(seen_from_above(place, {kIdentity}), kFirstActor) == pixels);
}

}  // namespace ties_test
