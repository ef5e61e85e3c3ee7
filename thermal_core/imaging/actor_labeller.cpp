#include "imaging/actor_labeller.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"
#include "base/plausible.h"
#include "base/text.h"
#include "scene/camera_geometry.h"

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

namespace {

std::vector<ManifestObject> actors_of(const Manifest& manifest) {
  std::vector<ManifestObject> actors;
  for (const ManifestObject& object : manifest.objects) {
    if (object.object_class == ObjectClass::actor) actors.push_back(object);
  }
  std::sort(actors.begin(), actors.end(),
            [](const ManifestObject& a, const ManifestObject& b) { return a.index < b.index; });
  return actors;
}

std::vector<std::uint16_t> indices_of(const std::vector<ManifestObject>& actors) {
  std::vector<std::uint16_t> indices;
  for (const ManifestObject& actor : actors) indices.push_back(actor.index);
  return indices;
}

/// Whether every frame has poses of the camera and of each actor's box.
bool has_all_places(const Manifest& manifest) {
  const auto is_placed = [](const ManifestObject& object, const ManifestFrame& frame) {
    return object.object_class != ObjectClass::actor ||
           (object.bounds_m &&
            std::ranges::find(frame.actors, object.index, &ActorPose::index) != frame.actors.end());
  };
  return std::ranges::all_of(manifest.frames, [&](const ManifestFrame& frame) {
    return frame.camera_to_world && std::ranges::all_of(manifest.objects, [&](const ManifestObject& object) {
             return is_placed(object, frame);
           });
  });
}

/// Finds an entry of an ascending list; null if absent.
template <typename List>
auto* find_index(List& list, std::uint16_t index) {
  const auto found =
      std::lower_bound(list.begin(), list.end(), index,
                       [](const auto& each, std::uint16_t wanted) { return each.index < wanted; });
  return found != list.end() && found->index == index ? &*found : nullptr;
}

LabelBox to_label(const PixelBox& box) {
  return {.x_px = static_cast<double>(box.x_px),
          .y_px = static_cast<double>(box.y_px),
          .width_px = static_cast<double>(box.width_px),
          .height_px = static_cast<double>(box.height_px)};
}

PixelBox around(const PixelBox& a, const PixelBox& b) {
  const int left = std::min(a.x_px, b.x_px);
  const int top = std::min(a.y_px, b.y_px);
  const int right = std::max(a.x_px + a.width_px, b.x_px + b.width_px);
  const int bottom = std::max(a.y_px + a.height_px, b.y_px + b.height_px);
  return {left, top, right - left, bottom - top};
}

}  // namespace

/// One index plane of a frame, as rendered and as resampled to the picture.
struct ActorLabeller::Layer {
  const Plane<std::uint16_t>* fine = nullptr;
  std::span<const IndexUse> fine_uses;
  Plane<std::uint16_t> reshaped;  ///< empty: the picture is the fine plane
  std::vector<IndexUse> reshaped_uses;

  [[nodiscard]] const Plane<std::uint16_t>& picture() const { return reshaped.empty() ? *fine : reshaped; }
  [[nodiscard]] std::span<const IndexUse> uses() const {
    return reshaped.empty() ? fine_uses : std::span<const IndexUse>(reshaped_uses);
  }
};

ActorLabeller::ActorLabeller(const Manifest& manifest, const LensDistortion& lens,
                             std::shared_ptr<const ResampleMap> map)
    : camera_(manifest.camera),
      passes_camera_(passes_camera(manifest)),
      lens_(lens),
      passes_lens_(manifest.lens),
      wants_depth_(!has_all_places(manifest)),
      supersample_(manifest.supersample),
      map_(std::move(map)),
      times_shown_(map_ && supersample_ > 1 ? map_->times_shown() : Plane<std::uint16_t>()),
      actors_(actors_of(manifest)),
      is_actor_(indices_of(actors_)) {}

std::vector<Instance> ActorLabeller::label(const Passes& passes, std::span<const IndexUse> uses,
                                           const ManifestFrame& frame) const {
  const bool layered = !passes.actor_index.empty();
  const std::vector<IndexUse> alone_uses =
      layered ? survey_indices(passes.actor_index) : std::vector<IndexUse>();
  check_actors(alone_uses);
  const Layer all = layer_of(passes.object_index, uses);
  const Layer alone = layered ? layer_of(passes.actor_index, alone_uses) : Layer();
  std::vector<Instance> instances = extract_instances(all.picture(), all.uses(), is_actor_);
  for (Instance& instance : instances) set_visible(all, layered ? &alone : nullptr, instance);
  set_places(frame, instances);
  for (Instance& instance : instances) {
    if (!instance.range_m) instance.range_m = mean_range_m(passes, *find_use(uses, instance.index));
  }
  return instances;
}

ActorLabeller::Layer ActorLabeller::layer_of(const Plane<std::uint16_t>& fine,
                                             std::span<const IndexUse> uses) const {
  Layer layer = {.fine = &fine, .fine_uses = uses, .reshaped = {}, .reshaped_uses = {}};
  if (supersample_ == 1 && !map_) return layer;
  layer.reshaped = in_picture(fine, uses);
  layer.reshaped_uses = survey_indices(layer.reshaped);
  return layer;
}

Plane<std::uint16_t> ActorLabeller::in_picture(const Plane<std::uint16_t>& fine,
                                               std::span<const IndexUse> uses) const {
  if (supersample_ == 1) return map_->resample_nearest(fine);
  Plane<std::uint16_t> coarse = block_actors(fine, supersample_, uses, is_actor_);
  return map_ ? map_->resample_nearest(coarse) : coarse;
}

/// Pixels of the passes with an index, weighted by how often the picture shows each.
double ActorLabeller::shown_px(const Layer& layer, std::uint16_t index) const {
  const IndexUse* coarse = find_use(layer.uses(), index);
  if (supersample_ == 1) return coarse != nullptr ? coarse->pixels : 0;
  const IndexUse* use = find_use(layer.fine_uses, index);
  if (use == nullptr) return 0;
  if (!map_) return use->pixels;
  std::uint64_t shown = 0;
  for (int y = use->box.y_px; y < use->box.y_px + use->box.height_px; ++y) {
    for (int x = use->box.x_px; x < use->box.x_px + use->box.width_px; ++x) {
      if (layer.fine->at(x, y) == index) shown += times_shown_.at(x / supersample_, y / supersample_);
    }
  }
  return static_cast<double>(shown);
}

void ActorLabeller::check_actors(std::span<const IndexUse> uses) const {
  for (const IndexUse& use : uses) {
    if (use.index == 0 || is_actor_.contains(use.index)) continue;
    std::vector<std::string> names = {"0"};
    for (const ManifestObject& actor : actors_) names.push_back(fmt::format("{}", actor.index));
    throw DataError(
        fmt::format("actor layer's object index at pixel ({}, {}) = {} ({} pixels); expected an index of the "
                    "manifest's actors: {}",
                    use.first_x_px, use.first_y_px, use.index, use.pixels, list_names(names)));
  }
}

void ActorLabeller::set_visible(const Layer& all, const Layer* alone, Instance& instance) const {
  const double seen = shown_px(all, instance.index);
  if (supersample_ > 1) instance.covered_px = seen / (supersample_ * supersample_);
  PixelBox box = instance.box;
  if (alone != nullptr) {
    const double there = shown_px(*alone, instance.index);
    if (there > 0) instance.visibility = std::min(1.0, seen / there);
    if (const IndexUse* use = find_use(alone->uses(), instance.index)) box = around(box, use->box);
  }
  instance.truncated = touches_border(box, camera_.width_px, camera_.height_px);
  instance.whole_box = to_label(box);
}

/// Sets members that follow from poses alone, where given.
void ActorLabeller::set_places(const ManifestFrame& frame, std::vector<Instance>& instances) const {
  for (const ActorPose& pose : frame.actors) {
    Instance* instance = find_index(instances, pose.index);
    if (instance == nullptr || !frame.camera_to_world) continue;
    const auto seen = see_box(camera_, lens_, *find_index(actors_, pose.index), pose, *frame.camera_to_world);
    if (!seen) continue;
    instance->range_m = seen->range_m;
    if (!instance->truncated || !seen->box_px) continue;
    const double inside_px = instance->whole_box->area_px();
    instance->whole_box = extended(*instance->whole_box, *seen->box_px, camera_);
    instance->truncated_fraction = 1 - inside_px / instance->whole_box->area_px();
  }
  for (Instance& instance : instances) {
    if (!instance.truncated) instance.truncated_fraction = 0;
    if (!instance.truncated_fraction) instance.whole_box.reset();
  }
}

/// Mean over the pixels of the passes; depth is along the camera's axis.
std::optional<double> ActorLabeller::mean_range_m(const Passes& passes, const IndexUse& use) const {
  if (passes.depth_m.empty()) return std::nullopt;
  double sum_m = 0;
  int pixels = 0;
  for (int y = use.box.y_px; y < use.box.y_px + use.box.height_px; ++y) {
    for (int x = use.box.x_px; x < use.box.x_px + use.box.width_px; ++x) {
      const auto depth_m = static_cast<double>(passes.depth_m.at(x, y));
      if (passes.object_index.at(x, y) != use.index || !kDistanceM.holds(depth_m)) continue;
      const LensPoint ray = unproject(passes_camera_, passes_lens_, {x + 0.5, y + 0.5});
      sum_m += depth_m * std::hypot(ray.x, ray.y, 1);
      ++pixels;
    }
  }
  return pixels > 0 ? std::optional<double>(sum_m / pixels) : std::nullopt;
}

}  // namespace thermal
