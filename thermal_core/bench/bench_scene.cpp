#include "bench/bench_scene.h"

#include <cmath>

#include "imaging/sampling.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

enum Index : std::uint16_t { kSoil = 1, kGrass = 2, kWater = 3, kShrub = 4, kHuman = 10, kElephant = 11 };

Manifest manifest_of(const CameraIntrinsics& camera, double height_m, double look_angle_rad) {
  Manifest manifest;
  manifest.clip = "bench";
  manifest.camera = camera;
  const auto place = [&manifest](std::uint16_t index, const std::string& name, ObjectClass object_class) {
    ManifestObject object;
    object.index = index;
    object.name = name;
    object.object_class = object_class;
    object.material = name;
    manifest.objects.push_back(object);
  };
  place(kSoil, "soil", ObjectClass::ground);
  place(kGrass, "grass", ObjectClass::ground);
  place(kWater, "water", ObjectClass::water);
  place(kShrub, "shrub", ObjectClass::plant);
  for (const auto& [index, name] : {std::pair{kHuman, "human"}, std::pair{kElephant, "elephant"}}) {
    place(index, name, ObjectClass::actor);
    manifest.objects.back().category = name;
    manifest.objects.back().track_id = index;
  }
  const double sine = std::sin(look_angle_rad);
  const double cosine = std::cos(look_angle_rad);
  ManifestFrame frame;  // the camera looks north and down
  frame.file = "000000.exr";
  frame.agl_m = height_m;
  frame.camera_to_world = {1, 0, 0, 0, 0, -sine, cosine, 0, 0, -cosine, -sine, height_m, 0, 0, 0, 1};
  manifest.frames.push_back(frame);
  return manifest;
}

/// Object index at a position: patches a few metres across, a pond, an occasional shrub or animal.
std::uint16_t index_at(double x_m, double y_m) {
  const double patches = std::sin(0.4 * x_m) + std::sin(0.31 * y_m + 1.3 * std::sin(0.11 * x_m));
  if (std::hypot(x_m + 14, y_m - 70) < 9) return kWater;
  if (std::sin(1.7 * x_m + 2) * std::sin(1.9 * y_m) > 0.93) return kShrub;
  if (std::hypot((x_m - 6) / 1.4, (y_m - 50) / 0.7) < 2) return kElephant;
  if (std::hypot(x_m - 2, y_m - 58) < 0.5) return kHuman;
  return patches > 0 ? kGrass : kSoil;
}

CameraIntrinsics vue_pro_13mm() {
  constexpr double kFocalLengthPx = 0.013 / 17e-6;
  return {.width_px = 640,
          .height_px = 512,
          .fx_px = kFocalLengthPx,
          .fy_px = kFocalLengthPx,
          .cx_px = 320,
          .cy_px = 256};
}

template <typename T>
Plane<T> enlarged_plane(const Plane<T>& plane, int factor) {
  Plane<T> large(plane.width_px() * factor, plane.height_px() * factor);
  if (plane.empty()) return large;
  for (int y = 0; y < large.height_px(); ++y) {
    for (int x = 0; x < large.width_px(); ++x) large.at(x, y) = plane.at(x / factor, y / factor);
  }
  return large;
}

}  // namespace

BenchScene rolling_ground() {
  constexpr double kHeight = 61;
  constexpr double kLookAngle = 0.7853981633974483;
  BenchScene scene;
  scene.manifest = manifest_of(vue_pro_13mm(), kHeight, kLookAngle);
  const CameraRays rays(scene.manifest.camera);
  const CameraPose pose = pose_of(*scene.manifest.frames[0].camera_to_world);
  const int width = scene.manifest.camera.width_px;
  const int height = scene.manifest.camera.height_px;
  scene.passes.object_index = Plane<std::uint16_t>(width, height);
  scene.passes.material_index = Plane<std::uint16_t>(width, height);
  scene.passes.depth_m = Plane<float>(width, height);
  for (Plane<float>& axis : scene.passes.normal) axis = Plane<float>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto ray_x = static_cast<double>(rays.x().at(x, y));
      const auto ray_y = static_cast<double>(rays.y().at(x, y));
      const auto& r = pose.rotation;
      const double down = -(static_cast<double>(r[2][0]) * ray_x + static_cast<double>(r[2][1]) * ray_y +
                            static_cast<double>(r[2][2]));
      const double depth_m = kHeight / down;
      const double x_m = depth_m * ray_x;
      const double y_m = depth_m * (static_cast<double>(r[1][1]) * ray_y + static_cast<double>(r[1][2]));
      const double slope_x = 0.2 * std::sin(0.05 * x_m);
      const double slope_y = 0.2 * std::cos(0.04 * y_m);
      const double norm = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
      scene.passes.object_index.at(x, y) = index_at(x_m, y_m);
      scene.passes.depth_m.at(x, y) = static_cast<float>(depth_m);
      scene.passes.normal[0].at(x, y) = static_cast<float>(-slope_x / norm);
      scene.passes.normal[1].at(x, y) = static_cast<float>(-slope_y / norm);
      scene.passes.normal[2].at(x, y) = static_cast<float>(1 / norm);
    }
  }
  return scene;
}

BenchScene person_from_above(int factor, double x_px, double y_px) {
  constexpr double kHeight = 122;
  constexpr double kStraightDown = 1.5707963267948966;
  constexpr double kShoulders = 0.25;  // half widths of a person from above
  constexpr double kChest = 0.14;
  constexpr double kHeadTop = 1.75;
  CameraIntrinsics camera = vue_pro_13mm();
  camera.width_px = camera.height_px = 32;
  camera.cx_px = camera.cy_px = 16;
  BenchScene scene;
  scene.manifest = manifest_of(camera, kHeight, kStraightDown);
  scene.manifest.supersample = factor;
  const CameraIntrinsics fine = finer(camera, factor);
  scene.passes.object_index = Plane<std::uint16_t>(fine.width_px, fine.height_px, kSoil);
  const double pixels_per_m = fine.fx_px / (kHeight - kHeadTop);
  for (int y = 0; y < fine.height_px; ++y) {
    for (int x = 0; x < fine.width_px; ++x) {
      const double dx_m = (x + 0.5 - factor * x_px) / pixels_per_m;
      const double dy_m = (y + 0.5 - factor * y_px) / pixels_per_m;
      if (std::hypot(dx_m / kShoulders, dy_m / kChest) < 1) scene.passes.object_index.at(x, y) = kHuman;
    }
  }
  return scene;
}

BenchScene enlarged(const BenchScene& scene, int factor) {
  BenchScene large{.manifest = scene.manifest, .passes = {}};
  large.manifest.camera = finer(scene.manifest.camera, factor);
  large.passes.object_index = enlarged_plane(scene.passes.object_index, factor);
  large.passes.material_index = enlarged_plane(scene.passes.material_index, factor);
  large.passes.depth_m = enlarged_plane(scene.passes.depth_m, factor);
  for (std::size_t axis = 0; axis < 3; ++axis)
    large.passes.normal[axis] = enlarged_plane(scene.passes.normal[axis], factor);
  return large;
}

}  // namespace thermal
