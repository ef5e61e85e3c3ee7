#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/baked_scene.h"
#include "support/shapes.h"

/// Baked scenes and tracks that tests build in memory.
namespace small_scene {

using thermal::CameraIntrinsics;
using Matrix = thermal::Transform<double>;

inline constexpr Matrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

inline constexpr std::uint16_t kGround = 1;
inline constexpr std::uint16_t kWater = 2;
inline constexpr std::uint16_t kTree = 3;
inline constexpr std::uint16_t kShrub = 4;
inline constexpr std::uint16_t kFirstActor = 10;

/// As a plan has plants: sine and cosine are of an angle in single precision.
inline Matrix upright(double x_m, double y_m, double z_m, double turn_rad = 0, double size = 1) {
  const double cos = static_cast<float>(std::cos(turn_rad));
  const double sin = static_cast<float>(std::sin(turn_rad));
  return {size * cos, -size * sin, 0, x_m, size * sin, size * cos, 0, y_m, 0, 0, size, z_m};
}

/// A bone at a place, turned about z, with a scale for each axis.
inline Matrix posed(double x_m, double y_m, double z_m, double turn_rad = 0,
                    const std::array<double, 3>& scale = {1, 1, 1}) {
  const double cos = std::cos(turn_rad);
  const double sin = std::sin(turn_rad);
  return {
      scale[0] * cos, -scale[1] * sin, 0, x_m, scale[0] * sin, scale[1] * cos, 0, y_m, 0, 0, scale[2], z_m};
}

/// A place, and what its baked scene refers to.
struct Scenery {
  struct Plants {
    std::uint16_t object = 0;
    std::vector<Matrix> transform;
    std::vector<std::uint32_t> mesh;
  };

  std::vector<shapes::Shape> meshes;
  std::vector<thermal::BakedSurface> surfaces;
  std::vector<Plants> plants;
  std::vector<thermal::BakedActor> actors;

  std::size_t mesh(shapes::Shape shape) {
    meshes.push_back(std::move(shape));
    return meshes.size() - 1;
  }
  void surface(std::uint16_t object, shapes::Shape shape) {
    surfaces.push_back({.object = object, .mesh = mesh(std::move(shape))});
  }
  /// One plant of a species of its own.
  void plant(std::uint16_t object, shapes::Shape shape, const Matrix& at) {
    const auto number = static_cast<std::uint32_t>(mesh(std::move(shape)));
    plants.push_back({.object = object, .transform = {at}, .mesh = {number}});
  }
  /// Objects are numbered from kFirstActor; each bone has a mesh.
  void actor(std::vector<shapes::Shape> bones) {
    thermal::BakedActor& one = actors.emplace_back();
    one.object = static_cast<std::uint16_t>(kFirstActor + actors.size() - 1);
    for (shapes::Shape& bone : bones) one.bones.push_back({.name = {}, .mesh = mesh(std::move(bone))});
  }

  /// This object must stay as and where it is.
  [[nodiscard]] thermal::BakedScene baked() const {
    thermal::BakedScene scene;
    scene.depth_range_m = {0.1, 20000};
    for (const shapes::Shape& shape : meshes) {
      scene.meshes.push_back({.name = {},
                              .smooth = shape.smooth,
                              .points_m = shape.points_m,
                              .triangles = shape.triangles,
                              .material_index = shape.materials});
    }
    scene.surfaces = surfaces;
    for (const Plants& one : plants)
      scene.plants.push_back(
          {.name = {}, .object = one.object, .transform = one.transform, .mesh = one.mesh});
    scene.actors = actors;
    return scene;
  }
};

using Axis = std::array<double, 3>;

inline Axis crossed(const Axis& a, const Axis& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Axis unit(const Axis& a) {
  const double size = std::hypot(a[0], a[1], a[2]);
  return {a[0] / size, a[1] / size, a[2] / size};
}

/// The pose of a camera that looks from one place to another, in single precision, as renderers have it.
/// `up` is a direction that is upwards in the picture; not that of sight.
inline std::array<double, 16> looking(const Axis& from_m, const Axis& to_m, const Axis& up = {0, 0, 1}) {
  const Axis forward = unit({to_m[0] - from_m[0], to_m[1] - from_m[1], to_m[2] - from_m[2]});
  const Axis right = unit(crossed(forward, up));
  const Axis down = crossed(forward, right);
  std::array<double, 16> pose{};
  for (std::size_t row = 0; row < 3; ++row) {
    pose.at(4 * row) = static_cast<float>(right.at(row));
    pose.at(4 * row + 1) = static_cast<float>(down.at(row));
    pose.at(4 * row + 2) = static_cast<float>(forward.at(row));
    pose.at(4 * row + 3) = static_cast<float>(from_m.at(row));
  }
  pose[15] = 1;
  return pose;
}

/// Straight down from a height; the picture's right is x, its upper side y.
inline std::array<double, 16> looking_down(double x_m, double y_m, double z_m) {
  return looking({x_m, y_m, z_m}, {x_m, y_m, z_m - 1}, {0, 1, 0});
}

/// Frames of a clip, and what its baked track refers to.
struct Clip {
  std::vector<std::array<double, 16>> camera_to_world;
  /// [actor][frame][bone]; an actor that is not posed in a frame has no bones in it.
  std::vector<std::vector<std::vector<Matrix>>> poses;

  std::vector<std::uint8_t> posed_flags = {};
  std::vector<thermal::Transform<float>> bones = {};
  std::vector<std::array<double, 3>> places_m = {};
  std::vector<double> headings_rad = {};

  /// This object must stay as and where it is.
  [[nodiscard]] thermal::BakedTrack baked() {
    posed_flags.clear();
    bones.clear();
    for (const auto& actor : poses) {
      for (const auto& frame : actor) {
        posed_flags.push_back(frame.empty() ? 0 : 1);
        for (const Matrix& bone : frame) {
          thermal::Transform<float>& to_world = bones.emplace_back();
          for (std::size_t k = 0; k < bone.size(); ++k) to_world.at(k) = static_cast<float>(bone.at(k));
        }
      }
    }
    places_m.assign(posed_flags.size(), {});  // nothing here needs them
    headings_rad.assign(posed_flags.size(), 0);
    thermal::BakedTrack track;
    track.frames = camera_to_world.size();
    track.camera_to_world = camera_to_world;
    track.actor_position_m = places_m;
    track.actor_heading_rad = headings_rad;
    track.posed = posed_flags;
    track.bones = bones;
    return track;
  }
};

/// A camera with its axis in the middle.
inline CameraIntrinsics pinhole(int width_px, int height_px, double f_px) {
  return {.width_px = width_px,
          .height_px = height_px,
          .fx_px = f_px,
          .fy_px = f_px,
          .cx_px = width_px / 2.0,
          .cy_px = height_px / 2.0};
}

}  // namespace small_scene
