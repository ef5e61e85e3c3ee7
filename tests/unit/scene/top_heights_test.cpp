#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "scene/ground_maps.h"
#include "support/catch.h"
#include "support/grove.h"

namespace top_heights_test {

using namespace small_scene;
using Catch::Matchers::WithinAbs;

namespace {

constexpr float kNone = -std::numeric_limits<float>::infinity();

thermal::TopHeights tops(const Scenery& place, double size_m, std::size_t cells) {
  const thermal::BakedScene scene = place.baked();
  return thermal::top_heights(scene, size_m, cells);
}

}  // namespace

TEST_CASE("Sloping ground has its height in the middle of every cell, without gaps") {
  const auto slope = [](double x, double y) { return 0.25 * x - 0.5 * y + 3; };
  Scenery place;
  place.surface(kGround, shapes::field(16, 16, 1, slope));
  for (const std::size_t cells : {1U, 7U, 16U, 32U, 45U}) {  // also on edges and corners of triangles
    const std::vector<float> ground_m = tops(place, 16, cells).ground_m;
    for (std::size_t k = 0; k < ground_m.size(); ++k) {
      const double x_m = thermal::cell_middle_m(16, cells, k % cells);
      const double y_m = thermal::cell_middle_m(16, cells, k / cells);
      CHECK_THAT(ground_m[k], WithinAbs(slope(x_m, y_m), 1e-5));
    }
  }
}

TEST_CASE("Of ground and water the higher one counts, and plants stand apart") {
  Scenery place;
  place.surface(kGround, shapes::level(10, 1, 1, -2));
  place.surface(kWater, shapes::level(4, 1, 2, -1));
  place.plant(kTree, shapes::box({-.4F, -.4F, 0}, {.4F, .4F, 3}, 3), upright(2.5, -3.5, -2, 0, 1.1));
  const thermal::TopHeights found = tops(place, 10, 10);
  CHECK(found.ground_m[0] == -2);
  CHECK(found.ground_m[5 * 10 + 5] == -1);
  CHECK_THAT(found.plants_m[1 * 10 + 7], WithinAbs(1.3, 1e-6));
  CHECK(std::ranges::count(found.plants_m, kNone) == 99);
}

TEST_CASE("Outside of all triangles there is nothing") {
  Scenery place;
  place.surface(kGround, shapes::level(2, 1, 1));
  place.surface(kGround, shapes::of({{0, 0, 0}, {0, 1, 5}, {0, 2, 9}}, {{0, 1, 2}}, 1));  // upright
  place.surface(kGround, shapes::of({{0, 0, 8}}, {{0, 0, 0}}, 1));                        // a point
  place.surface(kGround,
                shapes::of({{3e38F, 3e38F, 1}, {-3e38F, 3e38F, 1}, {3e38F, 2e38F, 1}}, {{0, 1, 2}}, 1));
  const thermal::TopHeights found = tops(place, 4, 4);
  CHECK(std::ranges::count(found.ground_m, 0) == 4);
  CHECK(std::ranges::count(found.ground_m, kNone) == 12);
  CHECK(std::ranges::count(found.plants_m, kNone) == 16);
}

TEST_CASE("Any number of threads finds the same heights") {
  const Scenery place = grove::place();
  const auto by = [&place](int threads) {
    return thermal::with_threads(threads, [&place] { return tops(place, 40, 80); });
  };
  const thermal::TopHeights one = by(1);
  CHECK(by(2).ground_m == one.ground_m);
  CHECK(by(2).plants_m == one.plants_m);
}

TEST_CASE("Maps have cells of at most 1 m, up to 4096 along a side") {
  CHECK(thermal::ground_map_cells(0.2) == 1);
  CHECK(thermal::ground_map_cells(20) == 20);
  CHECK(thermal::ground_map_cells(1609.3) == 1610);
  CHECK(thermal::ground_map_cells(4096) == 4096);
  CHECK(thermal::ground_map_cells(10000) == 4096);
  CHECK(thermal::ground_map_cells(1e300) == 4096);
  CHECK(thermal::cell_middle_m(10, 5, 0) == -4);
  CHECK(thermal::cell_middle_m(10, 5, 2) == 0);
}

}  // namespace top_heights_test
