#include "raycast/ground_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "raycast/ray_caster.h"
#include "support/catch.h"
#include "support/grove.h"

namespace ground_light_test {

using namespace small_scene;
using Catch::Matchers::WithinAbs;
using thermal::GroundMaps;
using thermal::SunDay;

namespace {

// With n rays, a border of length L in the unit square runs through about L sqrt(n) cells of the lattice. Each of them
// counts by 1 / n too much or too little, at most, with a variance of at most 1 / (4 n^2). So the error's standard
// deviation is sqrt(L sqrt(n)) / 2 n: 0.0049 for n = 987 and L = 3, more than any border here. Five of them and the
// rounding to bytes:
constexpr std::size_t kManyRays = 987;
constexpr double kTolerance = 5 * 0.0049 + 0.5 / 255;

/// Maps of level ground.
GroundMaps level(double size_m, std::size_t cells, float height_m = 0) {
  GroundMaps maps;
  maps.size_m = size_m;
  maps.cells = cells;
  maps.height_m.assign(cells * cells, height_m);
  return maps;
}

GroundMaps lit(const Scenery& place, GroundMaps maps, const std::vector<SunDay>& days = {},
               std::size_t rays = kManyRays) {
  const thermal::BakedScene scene = place.baked();
  const std::size_t side = thermal::blocks_along(maps.cells);
  thermal::trace_ground_light(thermal::RayCaster(scene), days, thermal::BlockRays(side * side, rays), maps);
  return maps;
}

double view(const GroundMaps& maps, std::size_t cell) { return maps.sky_view[cell] / 255.0; }

/// The sky view of the origin, at this height.
double view_of_origin(const Scenery& place, float height_m = 0) {
  return view(lit(place, level(1, 1, height_m)), 0);
}

/// A level disc of 256 corners around the z axis, whose area is 1e-4 of it too small.
shapes::Shape disc(double radius_m, float height_m) {
  constexpr std::uint32_t kCorners = 256;
  shapes::Shape shape;
  for (std::uint32_t k = 0; k < kCorners; ++k) {
    const double turn_rad = 2 * std::numbers::pi * k / kCorners;
    shape.points_m.push_back({static_cast<float>(radius_m * std::cos(turn_rad)),
                              static_cast<float>(radius_m * std::sin(turn_rad)), height_m});
  }
  for (std::uint32_t k = 1; k + 1 < kCorners; ++k) shape.triangles.push_back({0, k, k + 1});
  return shapes::painted(std::move(shape), 1);
}

/// The side of an upright cylinder around the z axis.
shapes::Shape tube(double radius_m, float low_m, float high_m) {
  constexpr std::uint32_t kCorners = 256;
  shapes::Shape shape = disc(radius_m, low_m);
  const shapes::Shape top = disc(radius_m, high_m);
  shape.points_m.insert(shape.points_m.end(), top.points_m.begin(), top.points_m.end());
  shape.triangles.clear();
  for (std::uint32_t k = 0; k < kCorners; ++k) {
    const std::uint32_t next = (k + 1) % kCorners;
    shape.triangles.push_back({k, next, next + kCorners});
    shape.triangles.push_back({k, next + kCorners, k + kCorners});
  }
  return shapes::painted(std::move(shape), 1);
}

/// A wall along y, 2 km long, that stands on the ground.
shapes::Shape wall(float x_m, float height_m) {
  return shapes::of({{x_m, -1000, -1}, {x_m, 1000, -1}, {x_m, 1000, height_m}, {x_m, -1000, height_m}},
                    {{0, 1, 2}, {0, 2, 3}}, 1);
}

/// The sun at noon is `noon_deg` above the northern horizon; it rises in the east at 6 and sets in the west at 18.
SunDay day_of(double noon_deg) {
  SunDay day;
  const double lean_rad = noon_deg * std::numbers::pi / 180;
  for (std::size_t k = 0; k < day.sun.size(); ++k) {
    const double turn_rad = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5 - 6) / 24;
    day.sun[k] = {std::cos(turn_rad), std::sin(turn_rad) * std::cos(lean_rad),
                  std::sin(turn_rad) * std::sin(lean_rad)};
  }
  return day;
}

}  // namespace

TEST_CASE("Open level ground sees all of the sky, also at the border of the map") {
  Scenery place;
  place.surface(kGround, shapes::level(40, 7, 1, 3));
  const GroundMaps maps = lit(place, level(30, 5, 3), {day_of(90)}, 13);
  for (const std::uint8_t one : maps.sky_view) CHECK(one == 255);
  for (const std::uint32_t hours : maps.sunlit.at(0).hours) CHECK(hours == 0x3FFC0);  // 6 to 17
}

TEST_CASE("The ground of an empty place sees all of the sky") {
  const GroundMaps maps = lit({}, level(10, 3), {day_of(50)}, 8);
  CHECK(std::ranges::count(maps.sky_view, 255) == 9);
  CHECK(std::ranges::count(maps.sunlit.at(0).hours, 0x3FFC0U) == 9);
}

TEST_CASE("Below the ground and inside of a body there is no sky") {
  Scenery place;
  place.surface(kGround, shapes::level(2000, 1, 1));
  CHECK(view_of_origin(place, -1) < 0.002);
  Scenery inside;
  inside.plant(kTree, shapes::cube(2, 1), upright(0, 0, 0));
  CHECK(view_of_origin(inside) == 0);
}

TEST_CASE("A long wall hides half of what is below its angle") {
  // The view factor of a strip that starts in the plane of a small surface: (1 - cos(angle)) / 2.
  Scenery place;
  place.surface(kGround, wall(8, 6));
  const GroundMaps maps = lit(place, level(15, 15));
  for (std::size_t row = 0; row < 15; ++row) {
    for (std::size_t column = 0; column < 15; ++column) {
      const double distance_m = 8 - (static_cast<double>(column) - 7);
      const double expected = (1 + std::cos(std::atan(6 / distance_m))) / 2;
      INFO("at " << distance_m << " m from the wall");
      CHECK_THAT(view(maps, row * 15 + column), WithinAbs(expected, kTolerance));
    }
  }
}

TEST_CASE("A disc above hides r^2 / (r^2 + h^2)") {
  for (const double radius_m : {1.0, 3.0, 10.0}) {
    Scenery place;
    place.plant(kTree, disc(radius_m, 3), upright(0, 0, 0));
    const double expected = 1 - radius_m * radius_m / (radius_m * radius_m + 9);
    CHECK_THAT(view_of_origin(place), WithinAbs(expected, kTolerance));
  }
}

TEST_CASE("The bottom of a round pit sees r^2 / (r^2 + h^2)") {
  Scenery place;
  place.surface(kGround, shapes::joined(tube(2, -5, 0), disc(2, -5)));
  CHECK_THAT(view_of_origin(place, -5), WithinAbs(4.0 / 29, kTolerance));
}

TEST_CASE("Errors of cells have no common part") {
  // Each under a disc of its own, all alike: the mean error of 900 cells is a thirtieth of that of one, and rounding to
  // bytes has no preference.
  Scenery place;
  place.mesh(disc(0.3, 0.3F));
  place.plants = {{.object = kTree, .transform = {}, .mesh = {}}};
  for (int k = 0; k < 900; ++k) {
    place.plants[0].transform.push_back(upright(1000 * (k % 30 - 14.5), 1000 * (k / 30 - 14.5), 0));
    place.plants[0].mesh.push_back(0);
  }
  const GroundMaps maps = lit(place, level(30000, 30), {}, 55);
  double sum = 0;
  for (std::size_t k = 0; k < 900; ++k) sum += view(maps, k) / 900;
  const double height_m = 0.3 - 0.01;  // rays start above the ground
  const double expected = height_m * height_m / (height_m * height_m + 0.09);
  const double deviation = std::sqrt(3 * std::sqrt(55.0)) / (2 * 55) / 30;
  CHECK_THAT(sum, WithinAbs(expected, 5 * deviation + 2e-4));
}

TEST_CASE("A wall in the east hides the sun until it is above it") {
  Scenery place;
  place.surface(kGround, wall(6, 6));  // 45 deg at the origin
  const GroundMaps maps = lit(place, level(1, 1), {day_of(90), day_of(90)}, 8);
  CHECK(maps.sunlit.size() == 2);
  CHECK(maps.sunlit[0].hours.at(0) == 0x3FE00);  // 9:30 to 17:30
  CHECK(maps.sunlit[1].hours == maps.sunlit[0].hours);
}

TEST_CASE("Hours in which the sun is not above the horizon are dark") {
  SunDay day;
  day.path = {.latitude_deg = 3, .day_of_year = 4};
  day.sun.fill({1, 0, 0});
  day.sun[5] = {0, 0, std::numeric_limits<double>::quiet_NaN()};
  day.sun[6] = {0, 0, 1};
  day.sun[7] = {0, 0, -1};
  const GroundMaps maps = lit({}, level(1, 1), {day}, 8);
  CHECK(maps.sunlit.at(0).hours.at(0) == 1U << 6U);
  CHECK(maps.sunlit.at(0).path == day.path);
}

TEST_CASE("Shadows lie where crowns are, from the middle of a cell") {
  Scenery place;  // a slab over the cell in the third row and fourth column
  place.plant(kTree, shapes::box({-.4F, -.4F, 2}, {.4F, .4F, 3}, 1), upright(0.5, -0.5, 0));
  SunDay day;
  day.sun.fill({0, 0, -1});
  day.sun[12] = {0, 0, 1};
  const GroundMaps maps = lit(place, level(6, 6), {day}, 8);
  for (std::size_t cell = 0; cell < 36; ++cell)
    CHECK(maps.sunlit[0].hours[cell] == (cell == 2 * 6 + 3 ? 0U : 1U << 12U));
}

TEST_CASE("Cells that Embree cannot take see everything") {
  Scenery place;
  place.plant(kTree, shapes::cube(2, 1), upright(0, 0, 0));
  for (const double size_m : {1.0, 1e12, 1e300}) {
    GroundMaps maps = level(size_m, 2);
    maps.height_m = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -2e9F,
                     3e38F};
    maps = lit(place, maps, {day_of(90)}, 8);
    CHECK(std::ranges::count(maps.sky_view, 255) == 4);
    CHECK(std::ranges::count(maps.sunlit[0].hours, 0x3FFC0U) == 4);
  }
}

TEST_CASE("Actors hide nothing") {
  Scenery place;
  place.actor({shapes::cube(5, 1)});
  CHECK(view_of_origin(place) == 1);
}

namespace {

/// Of a grove of 40 m, on one cell of covers.
class GroveGround {
 public:
  GroveGround() : scene_(place_.baked()) {
    scene_.ground = {.size_m = 40,
                     .cells = 1,
                     .covers = {"grass"},
                     .height_m = heights_,
                     .shore_m = {},
                     .cover = all_,
                     .canopy = all_,
                     .fine_cells = 1,
                     .kind = none_,
                     .grass = all_,
                     .trodden = none_,
                     .ash = none_,
                     .border = all_};
  }

  [[nodiscard]] GroundMaps maps(const std::optional<std::vector<thermal::GroundView>>& views = {}) const {
    const std::vector<SunDay> days = {day_of(50)};
    return thermal::make_ground_maps(scene_, days, views);
  }

 private:
  Scenery place_ = grove::place();
  thermal::BakedScene scene_;
  std::vector<float> heights_ = std::vector<float>(4, 0.5F);
  std::vector<std::uint8_t> all_ = {255};
  std::vector<std::uint8_t> none_ = {0};
};

}  // namespace

TEST_CASE("Any number of threads makes the same maps") {
  const GroveGround ground;
  const auto made_by = [&](int threads) {
    return thermal::with_threads(threads, [&] { return ground.maps(); });
  };
  const GroundMaps one = made_by(1);
  CHECK(made_by(2) == one);
  CHECK(made_by(0) == one);
  CHECK(one.cells == 40);
  CHECK(one.covers == thermal::GroundCovers{1, {"grass"}, {0}, {255}, {0}, {0}, {255}});
  CHECK(std::ranges::max(one.crown_top_m) > 4.5F);
  CHECK(std::ranges::min(one.sky_view) < 100);
}

TEST_CASE("Where a camera sees the ground, maps are as if it saw everything, and open elsewhere") {
  const GroveGround ground;
  const GroundMaps whole = ground.maps();
  const thermal::GroundView above = {.camera = pinhole(64, 64, 64),
                                     .camera_to_world = {looking_down(3, 2, 9)}};
  const GroundMaps seen = ground.maps({{above}});
  CHECK(ground.maps({{above, above}}) == seen);
  CHECK((seen.height_m == whole.height_m && seen.crown_top_m == whole.crown_top_m));
  std::size_t traced = 0;
  for (std::size_t cell = 0; cell < whole.sky_view.size(); ++cell) {
    const double x_m = static_cast<double>(cell % 40) - 19.5;
    const double y_m = static_cast<double>(cell / 40) - 19.5;
    const bool same = seen.sky_view[cell] == whole.sky_view[cell] &&
                      seen.sunlit[0].hours[cell] == whole.sunlit[0].hours[cell];
    const bool open = seen.sky_view[cell] == 255 && seen.sunlit[0].hours[cell] == 0x3FFC0;
    INFO("at " << x_m << ", " << y_m);
    if (std::max(std::abs(x_m - 3), std::abs(y_m - 2)) < 8) CHECK(same);  // 4.5 m are in the picture
    if (std::max(std::abs(x_m - 3), std::abs(y_m - 2)) > 20) CHECK(open);
    CHECK((same || open));
    traced += same && !open ? 1 : 0;
  }
  CHECK(traced > 50);
}

TEST_CASE("Without a view, no ground is traced") {
  const GroundMaps maps = GroveGround().maps(std::vector<thermal::GroundView>{});
  CHECK(std::ranges::count(maps.sky_view, 255) == 1600);
}

TEST_CASE("Blocks have fewer rays the more of their cells a pixel holds") {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  CHECK(thermal::rays_for({0, 1.4F, 1.6F, 3.1F, 6.1F, 1000, kNever}, 0.5) ==
        thermal::BlockRays{89, 89, 34, 13, 8, 8, 0});
}

TEST_CASE("Cells that are done are shown in order") {
  std::vector<int> cells;
  GroundMaps maps = level(9, 135);
  const thermal::BakedScene scene;
  thermal::BlockRays rays(34 * 34, 8);
  rays.front() = 0;
  thermal::trace_ground_light(thermal::RayCaster(scene), {}, rays, maps, [&cells](int done, int total) {
    CHECK(total == 135 * 135 - 16);
    cells.push_back(done);
  });
  CHECK((cells.size() == 2 && cells.front() < cells.back() && cells.back() == 135 * 135 - 16));
}

}  // namespace ground_light_test
