#include "dataset/videos/trails.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <opencv2/calib3d.hpp>

namespace thermal {
namespace {

using Pose = std::array<double, 16>;

cv::Matx33d matrix_of(const FilmCamera& camera) {
  return {camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1};
}

/// Direction of the ray through a point of the picture in camera axes, z being 1.
cv::Vec3d ray_of(const FilmCamera& camera, const cv::Point2d& point) {
  const std::vector<cv::Point2d> shown = {point};
  std::vector<cv::Point2d> normalised;
  cv::undistortPoints(shown, normalised, matrix_of(camera), camera.distortion);
  return {normalised[0].x, normalised[0].y, 1};
}

cv::Vec3d to_world(const Pose& pose, const cv::Vec3d& camera_m) {
  cv::Vec3d world;
  for (int r = 0; r < 3; ++r) {
    const auto row = static_cast<std::size_t>(4 * r);
    world[r] =
        pose[row] * camera_m[0] + pose[row + 1] * camera_m[1] + pose[row + 2] * camera_m[2] + pose[row + 3];
  }
  return world;
}

/// World to camera axes, by the inverse of a rigid motion.
cv::Vec3d to_camera(const Pose& pose, const std::array<double, 3>& world_m) {
  cv::Vec3d camera;
  for (int c = 0; c < 3; ++c) {
    const auto column = static_cast<std::size_t>(c);
    for (std::size_t r = 0; r < 3; ++r) camera[c] += pose[4 * r + column] * (world_m[r] - pose[4 * r + 3]);
  }
  return camera;
}

/// Distance to the target along the ray, in lengths of the ray; empty if unknown.
std::optional<double> reach_of(const FilmFrame& frame, const Label& label, const cv::Vec3d& ray) {
  if (label.range_m) return *label.range_m / cv::norm(ray);
  const Pose& pose = *frame.camera_to_world;
  const double fall = -(pose[8] * ray[0] + pose[9] * ray[1] + pose[10] * ray[2]);
  if (!frame.agl_m || fall <= 0.05) return std::nullopt;
  return *frame.agl_m / fall;
}

/// Projection of a point of the scene; empty behind the camera or far out of the picture.
std::optional<cv::Point2d> shown_at(const FilmCamera& camera, const Pose& pose,
                                    const std::array<double, 3>& world_m) {
  const cv::Vec3d point = to_camera(pose, world_m);
  constexpr double kWidest = 2;  // tangent of the angle off the axis; the distortion model is invalid beyond
  if (point[2] <= 0 || std::hypot(point[0], point[1]) > kWidest * point[2]) return std::nullopt;
  std::vector<cv::Point2d> shown;
  cv::projectPoints(std::vector<cv::Point3d>{{point[0], point[1], point[2]}}, cv::Vec3d(), cv::Vec3d(),
                    matrix_of(camera), camera.distortion, shown);
  return shown[0];
}

}  // namespace

Trails::Trails(const ClipFilm& film, double seconds) : film_(film), seconds_(seconds) {
  for (std::size_t frame = 0; frame < film.frames.size(); ++frame) {
    for (std::size_t k = film.first_label[frame]; k < film.first_label[frame + 1]; ++k) {
      const Label& label = film.labels.labels[k];
      if (!label.track_id || label.truncated) continue;
      Track& track = tracks_[*label.track_id];
      track.category = label.category;
      track.marks.push_back(mark_of(frame, label));
    }
  }
}

Trails::Mark Trails::mark_of(std::size_t frame, const Label& label) const {
  const FilmFrame& taken = film_.frames[frame];
  Mark mark{.frame = frame,
            .x_px = label.box.x_px + label.box.width_px / 2,
            .y_px = label.box.y_px + label.box.height_px / 2};
  if (!film_.camera || !taken.camera_to_world) return mark;
  const cv::Vec3d ray = ray_of(*film_.camera, {mark.x_px, mark.y_px});
  const std::optional<double> reach = reach_of(taken, label, ray);
  if (!reach) return mark;
  const cv::Vec3d world = to_world(*taken.camera_to_world, *reach * ray);
  mark.world_m = {world[0], world[1], world[2]};
  mark.anchored = true;
  return mark;
}

std::vector<TrailPoint> Trails::points_of(const Track& track, std::size_t frame) const {
  const FilmFrame& now = film_.frames[frame];
  std::vector<TrailPoint> points;
  const auto age_of = [&](const Mark& mark) { return now.time_s - film_.frames[mark.frame].time_s; };
  const auto first =
      std::ranges::partition_point(track.marks, [&](const Mark& mark) { return age_of(mark) > seconds_; });
  for (auto at = first; at != track.marks.end() && at->frame <= frame; ++at) {
    const Mark& mark = *at;
    const double age_s = age_of(mark);
    if (!mark.anchored || !now.camera_to_world) {
      points.push_back({mark.x_px, mark.y_px, age_s});
      continue;
    }
    const auto shown = shown_at(*film_.camera, *now.camera_to_world, mark.world_m);
    if (shown) points.push_back({shown->x, shown->y, age_s});
  }
  return points;
}

std::vector<Trail> Trails::at(std::size_t frame) const {
  std::vector<Trail> trails;
  for (const auto& [id, track] : tracks_) {
    Trail trail{.track = id, .category = track.category, .points = points_of(track, frame)};
    if (trail.points.size() > 1) trails.push_back(std::move(trail));
  }
  return trails;
}

}  // namespace thermal
