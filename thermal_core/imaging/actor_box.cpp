#include "imaging/actor_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace thermal {
namespace {

using Vector = std::array<double, 3>;
using Corners = std::array<Vector, 8>;  // bits 0, 1 and 2 of the index: which end along x, y and z

/// Transforms a point from actor axes (x forward, y left, z up) to camera axes (x right, y down, z forward).
Vector to_camera(const Vector& local_m, const ActorPose& pose,
                 const std::array<double, 16>& camera_to_world) {
  const double cosine = std::cos(pose.heading_rad);
  const double sine = std::sin(pose.heading_rad);
  const Vector away_m = {pose.position_m[0] + cosine * local_m[0] - sine * local_m[1] - camera_to_world[3],
                         pose.position_m[1] + sine * local_m[0] + cosine * local_m[1] - camera_to_world[7],
                         pose.position_m[2] + local_m[2] - camera_to_world[11]};
  Vector seen_m{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t row = 0; row < 3; ++row) seen_m[axis] += camera_to_world[4 * row + axis] * away_m[row];
  }
  return seen_m;
}

/// Intersection of the edge between two corners with the near plane.
Vector cut(const Vector& before, const Vector& behind) {
  const double share = (before[2] - kNearestM) / (before[2] - behind[2]);
  return {before[0] + share * (behind[0] - before[0]), before[1] + share * (behind[1] - before[1]),
          kNearestM};
}

/// Corners of the part of the box in front of the camera.
std::vector<Vector> corners_before(const Corners& corners) {
  std::vector<Vector> before;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!(corners.at(i)[2] >= kNearestM)) continue;
    before.push_back(corners.at(i));
    for (const std::size_t bit : {1U, 2U, 4U}) {
      const Vector& neighbour = corners.at(i ^ bit);
      if (neighbour[2] < kNearestM) before.push_back(cut(corners.at(i), neighbour));
    }
  }
  return before;
}

/// Tangent of the angle between the axis and the picture's farthest corner.
double farthest_corner(const CameraIntrinsics& camera) {
  const double x = std::max(camera.cx_px, camera.width_px - camera.cx_px) / camera.fx_px;
  const double y = std::max(camera.cy_px, camera.height_px - camera.cy_px) / camera.fy_px;
  return std::hypot(x, y);
}

/// Moves outwards from the axis towards the point as long as the distortion is monotonic.
LensPoint shown_by(const LensDistortion& lens, LensPoint point, double reach) {
  if (lens.is_none()) return point;
  constexpr int kSteps = 96;  // at most a 32nd of the way to the picture's corner
  const double share = std::min(1.0, reach / std::hypot(point.x, point.y));
  point = {share * point.x, share * point.y};
  LensPoint shown;
  for (int i = 1; i <= kSteps; ++i) {
    const double way = static_cast<double>(i) / kSteps;
    const LensPoint next = distort(lens, {way * point.x, way * point.y});
    if (std::hypot(next.x, next.y) < std::hypot(shown.x, shown.y)) break;
    shown = next;
  }
  return shown;
}

LabelBox box_about(const std::vector<Vector>& points, const CameraIntrinsics& camera,
                   const LensDistortion& lens) {
  constexpr double kReach = 3;
  const double reach = kReach * farthest_corner(camera);
  std::vector<double> x_px;
  std::vector<double> y_px;
  for (const Vector& point : points) {
    const LensPoint shown = shown_by(lens, {point[0] / point[2], point[1] / point[2]}, reach);
    x_px.push_back(camera.fx_px * shown.x + camera.cx_px);
    y_px.push_back(camera.fy_px * shown.y + camera.cy_px);
  }
  const auto [left, right] = std::minmax_element(x_px.begin(), x_px.end());
  const auto [top, bottom] = std::minmax_element(y_px.begin(), y_px.end());
  return {.x_px = *left, .y_px = *top, .width_px = *right - *left, .height_px = *bottom - *top};
}

/// One side of a box within a frame from 0 to `size`.
struct Side {
  double low = 0;
  double high = 0;
};

Side extended(const Side& seen, const Side& box, double size) {
  const bool cut_low = seen.low == 0;
  const bool cut_high = seen.high == size;
  const double wider_low = cut_low ? 0 : std::max(0.0, seen.low - box.low);
  const double wider_high = cut_high ? 0 : std::max(0.0, box.high - seen.high);
  return {.low = cut_low ? std::min(seen.low, box.low + wider_high) : seen.low,
          .high = cut_high ? std::max(seen.high, box.high - wider_low) : seen.high};
}

}  // namespace

std::optional<SeenBox> see_box(const CameraIntrinsics& camera, const LensDistortion& lens,
                               const ManifestObject& actor, const ActorPose& pose,
                               const std::array<double, 16>& camera_to_world) {
  if (!actor.bounds_m) return std::nullopt;
  const auto& [low, high] = *actor.bounds_m;
  Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector local_m = {(i & 1U) == 0 ? low[0] : high[0], (i & 2U) == 0 ? low[1] : high[1],
                            (i & 4U) == 0 ? low[2] : high[2]};
    corners.at(i) = to_camera(local_m, pose, camera_to_world);
  }
  const Vector middle_m = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  const Vector seen_m = to_camera(middle_m, pose, camera_to_world);
  SeenBox seen = {.range_m = std::hypot(seen_m[0], seen_m[1], seen_m[2]), .box_px = {}};
  const std::vector<Vector> before = corners_before(corners);
  if (!before.empty()) seen.box_px = box_about(before, camera, lens);
  return seen;
}

LabelBox extended(const LabelBox& seen, const LabelBox& box, const CameraIntrinsics& camera) {
  const Side across =
      extended({seen.x_px, seen.x_px + seen.width_px}, {box.x_px, box.x_px + box.width_px}, camera.width_px);
  const Side down = extended({seen.y_px, seen.y_px + seen.height_px}, {box.y_px, box.y_px + box.height_px},
                             camera.height_px);
  return {.x_px = across.low,
          .y_px = down.low,
          .width_px = across.high - across.low,
          .height_px = down.high - down.low};
}

}  // namespace thermal
