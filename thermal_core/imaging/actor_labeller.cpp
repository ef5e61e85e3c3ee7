#include "imaging/actor_labeller.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"
#include "base/plausible.h"
#include "base/text.h"
#include "imaging/actor_box.h"
#include "imaging/supersample.h"
#include "scene/camera_geometry.h"

namespace thermal {
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
