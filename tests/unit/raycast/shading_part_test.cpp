#include "raycast/shading_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "raycast/ground_light.h"
#include "raycast/ray_caster.h"
#include "support/catch.h"
#include "support/small_scene.h"

namespace shading_part_test {

using namespace small_scene;
using thermal::EastNorthUp;
using thermal::GroundMaps;
using thermal::RayStart;
using thermal::ShadingPart;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Of an elevation, and an azimuth from north to east.
EastNorthUp sun_at(double elevation_deg, double azimuth_deg) {
  const double level = std::cos(elevation_deg * kDegree);
  return {level * std::sin(azimuth_deg * kDegree), level * std::cos(azimuth_deg * kDegree),
          std::sin(elevation_deg * kDegree)};
}

/// Level ground of 1600 m with slabs of 10 m, all of one mesh.
Scenery slabs_at(const std::vector<std::array<double, 2>>& places_m) {
  Scenery place;
  place.surface(kGround, shapes::level(1600, 40, 1));
  const auto mesh = static_cast<std::uint32_t>(place.mesh(shapes::box({-1, -1, 0}, {1, 1, 10}, 1)));
  place.plants = {{.object = kTree, .transform = {}, .mesh = {}}};
  for (const auto& [x_m, y_m] : places_m) {
    place.plants[0].transform.push_back(upright(x_m, y_m, 0));
    place.plants[0].mesh.push_back(mesh);
  }
  return place;
}

constexpr RayStart kMiddle = {.low_m = {-2, -2}, .high_m = {2, 2}, .height_m = 0};

/// How many plants are left.
std::size_t plants_for(const Scenery& place, const std::vector<RayStart>& starts,
                       const std::vector<EastNorthUp>& suns = {}) {
  const thermal::BakedScene scene = place.baked();
  return ShadingPart(scene, 1600, starts, suns).scene().plants.at(0).mesh.size();
}

}  // namespace

TEST_CASE("What rises by a degree and a half is kept, tile by tile") {
  // 10 m rise by 1.5 degrees 382 m away; a tile has 32 m.
  CHECK(plants_for(slabs_at({{300, 0}, {0, -300}, {-200, 200}}), {kMiddle}) == 3);
  CHECK(plants_for(slabs_at({{450, 0}, {0, -450}, {-320, 320}}), {kMiddle}) == 0);
  const RayStart below = {.low_m = kMiddle.low_m, .high_m = kMiddle.high_m, .height_m = -5};
  CHECK(plants_for(slabs_at({{450, 0}, {0, -450}, {-320, 320}}), {below}) == 3);
  const RayStart beside = {.low_m = {400, 0}, .high_m = {410, 4}, .height_m = 0};
  CHECK(plants_for(slabs_at({{450, 0}, {0, -450}}), {kMiddle, beside}) == 1);
}

TEST_CASE("What hides a low sun is kept, and nothing beside it") {
  const Scenery place = slabs_at({{700, 0}, {-700, 0}, {700, 100}, {0, 700}});
  CHECK(plants_for(place, {kMiddle}, {sun_at(0.5, 90)}) == 1);
  CHECK(plants_for(place, {kMiddle}, {sun_at(0.5, 90), sun_at(0.4, 270), sun_at(0.3, 0)}) == 3);
  CHECK(plants_for(place, {kMiddle}, {sun_at(1.0, 90)}) == 0);   // it passes above
  CHECK(plants_for(place, {kMiddle}, {sun_at(-0.5, 90)}) == 0);  // it is below the horizon
}

TEST_CASE("What reaches beyond the place is kept") {
  CHECK(plants_for(slabs_at({{799.5, 0}, {-900, 0}}), {kMiddle}) == 2);
}

TEST_CASE("Without a start, nothing is left") {
  const Scenery place = slabs_at({{0, 0}});
  const thermal::BakedScene scene = place.baked();
  const ShadingPart part(scene, 1600, {}, {});
  CHECK(part.scene().surfaces.empty());
  CHECK(part.scene().plants.at(0).mesh.empty());
}

TEST_CASE("Suns and sky of a place among hills are those of the whole scene") {
  const auto hills = [](double x_m, double y_m) {
    return 14 * std::sin(0.011 * x_m) * std::cos(0.007 * y_m) + 2 * std::sin(0.05 * x_m + 0.03 * y_m);
  };
  Scenery place;
  place.surface(kGround, shapes::field(1600, 160, 1, hills));
  const auto mesh = static_cast<std::uint32_t>(place.mesh(shapes::ball(4, 5, 6)));
  place.plants = {{.object = kTree, .transform = {}, .mesh = {}}};
  for (int k = 0; k < 4000; ++k) {
    const double x_m = std::fmod(k * 617.033989, 1590.0) - 795;
    const double y_m = std::fmod(k * 377.7544, 1590.0) - 795;
    place.plants[0].transform.push_back(upright(x_m, y_m, hills(x_m, y_m) + 3, k, 0.5 + (k % 7) / 7.0));
    place.plants[0].mesh.push_back(mesh);
  }
  const thermal::BakedScene scene = place.baked();
  GroundMaps whole;
  whole.size_m = 48;
  whole.cells = 48;
  RayStart start = {.low_m = {-24, -24}, .high_m = {24, 24}, .height_m = 100};
  for (int cell = 0; cell < 48 * 48; ++cell) {
    whole.height_m.push_back(static_cast<float>(hills(cell % 48 - 23.5, cell / 48 - 23.5)));
    start.height_m = std::min(start.height_m, static_cast<double>(whole.height_m.back()));
  }
  thermal::SunDay day;
  for (std::size_t k = 0; k < day.sun.size(); ++k)
    day.sun[k] = sun_at(0.15 * static_cast<double>(k) - 0.1, 15.0 * static_cast<double>(k));
  GroundMaps near = whole;
  const thermal::BlockRays rays(12 * 12, thermal::kSkyRays);
  thermal::trace_ground_light(thermal::RayCaster(scene), {{day}}, rays, whole);
  const ShadingPart part(scene, 1600, {{start}}, day.sun);
  thermal::trace_ground_light(thermal::RayCaster(part.scene()), {{day}}, rays, near);
  CHECK(near.sunlit == whole.sunlit);
  CHECK(std::ranges::count(whole.sunlit[0].hours, whole.sunlit[0].hours[0]) < 2000);  // there are shadows
  double left_out = 0;
  for (std::size_t k = 0; k < near.sky_view.size(); ++k) {
    CHECK(near.sky_view[k] >= whole.sky_view[k]);
    left_out += near.sky_view[k] - whole.sky_view[k];
  }
  CHECK(left_out / 255 / static_cast<double>(near.sky_view.size()) < 0.0007);
  CHECK(part.scene().plants.at(0).mesh.size() < 2000);
  CHECK(part.scene().meshes.at(0).triangles.size() < 160 * 160);
}

}  // namespace shading_part_test
