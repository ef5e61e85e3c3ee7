#pragma once

#include <cmath>

#include "support/small_scene.h"

/// A place with something of every kind: 1000 triangles, smooth and flat, in 8 materials.
namespace grove {

/// A pond in rolling ground, three trees, four shrubs and two actors of two bones.
inline small_scene::Scenery place() {
  using namespace small_scene;
  Scenery place;
  shapes::Shape ground = shapes::smoothed(shapes::field(
      40, 12, 1, [](double x, double y) { return 0.8 * std::sin(0.4 * x) * std::cos(0.3 * y); }));
  for (std::size_t k = 0; k < ground.materials.size(); k += 3) ground.materials[k] = 2;
  place.surface(kGround, ground);
  place.surface(kWater, shapes::level(14, 1, 3, 0.1));
  const auto tree = static_cast<std::uint32_t>(place.mesh(
      shapes::joined(shapes::box({-.2F, -.2F, -1}, {.2F, .2F, 3.5F}, 4), shapes::ball(1.5, 5, 5, 4.5))));
  const auto shrub = static_cast<std::uint32_t>(place.mesh(shapes::smoothed(shapes::ball(0.9, 5, 6))));
  place.plants = {
      {.object = kTree,
       .transform = {upright(3, 2, 0, 0.4, 1.1), upright(-5, 4, 0.3, 2.5, 0.8), upright(9, -6, 0, 4)},
       .mesh = {tree, tree, tree}},
      {.object = kShrub,
       .transform = {upright(0, -3, 0.2), upright(1, 7, 0.5, 1, 1.4), upright(-8, -8, 0, 3, 0.5),
                     upright(6, 6, 0.2, 5, 0.7)},
       .mesh = {shrub, shrub, shrub, shrub}}};
  for (int k = 0; k < 2; ++k)
    place.actor({shapes::box({-1, -.4F, -.8F}, {1, .4F, .4F}, 7), shapes::smoothed(shapes::ball(0.5, 4, 8))});
  return place;
}

/// Three frames around the place. The second actor is posed in the first and the last of them.
inline small_scene::Clip clip() {
  using namespace small_scene;
  const auto body = [](double x_m, double y_m, double turn_rad) {
    return std::vector<Matrix>{
        posed(x_m, y_m, 1.2, turn_rad),
        posed(x_m + std::cos(turn_rad), y_m + std::sin(turn_rad), 1.9, turn_rad, {1, 0.8, 1.2})};
  };
  return {.camera_to_world = {looking({-18, -12, 14}, {0, 0, 1}), looking({2, 16, 6}, {0, 0, 2}),
                              looking({10, -14, 22}, {1, 0, 0}, {0.2, 0.9, 0.1})},
          .poses = {{body(-2, -4, 0.3), body(-1, -4, 0.5), body(0, -4.5, 0.7)},
                    {body(4, 4.5, 2), {}, body(5, 3, 2.2)}}};
}

/// The axis is off the middle, and pixels are not square.
inline thermal::CameraIntrinsics camera() {
  return {.width_px = 53, .height_px = 41, .fx_px = 48, .fy_px = 55, .cx_px = 22.75, .cy_px = 24.5};
}

}  // namespace grove
