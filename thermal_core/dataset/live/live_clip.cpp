#include "dataset/live/live_clip.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/clip/annotations.h"
#include "dataset/clip/heat_days.h"
#include "dataset/outline/outline.h"
#include "io/config/materials.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

std::unique_ptr<ClipImager> imager_of(const ClipTask& task, const Manifest& manifest, ClipScenes& scenes) {
  const std::size_t scene = scenes.add(task);
  return std::make_unique<ClipImager>(task, manifest, scenes.brightest_w_m2_sr(scene),
                                      scenes.temperatures(task.settings().sensor.response));
}

/// Size of the planes that a manifest's renderer writes.
std::pair<int, int> size_of_planes(const Manifest& manifest) {
  const auto with_overscan = [&](int size_px) {
    return manifest.supersample * (size_px + 2 * manifest.overscan_px);
  };
  return {with_overscan(manifest.camera.width_px), with_overscan(manifest.camera.height_px)};
}

}  // namespace

LiveClip::LiveClip(Manifest manifest, std::shared_ptr<const MaterialLibrary> materials, ClipTask task)
    : manifest_(std::move(manifest)),
      materials_(std::move(materials)),
      task_(std::move(task)),
      scenes_(manifest_, *materials_),
      imager_(imager_of(task_, manifest_, scenes_)) {}

const ClipImager::Frame& LiveClip::make(const Passes& passes, int number) {
  const auto frames = static_cast<int>(manifest_.frames.size());
  if (number < next_ || number >= frames)
    throw ConfigError(
        fault("frame", std::to_string(number), "", fmt::format("a number from {} to {}", next_, frames - 1)));
  check(passes);
  scenes_.convert(passes, number, converted_);
  return expose(number, manifest_.frames[static_cast<std::size_t>(number)]);
}

const ClipImager::Frame& LiveClip::make(const Passes& passes, const ManifestFrame& frame, int number) {
  if (number < next_)
    throw ConfigError(fault("frame", std::to_string(number), "", fmt::format("a number from {} on", next_)));
  check(passes);
  scenes_.convert(passes, frame, last_ ? &*last_ : nullptr, converted_);
  return expose(number, frame);
}

Json LiveClip::labels() const {
  Json labels = Json::array();
  for (const Instance& instance : frame_.instances) {
    const auto actor = std::ranges::find(manifest_.objects, instance.index, &ManifestObject::index);
    Json label = {{"category", actor->category}};
    label.update(label_entry(instance, *actor, manifest_.camera, task_.settings().labels,
                             frame_.pictures.shutter_closed));
    labels.push_back(std::move(label));
  }
  return labels;
}

void LiveClip::restart(std::uint32_t seed) {
  task_.seed = seed;
  imager_ = imager_of(task_, manifest_, scenes_);
  last_.reset();
  next_ = 0;
}

const ClipImager::Frame& LiveClip::expose(int number, const ManifestFrame& frame) {
  for (; next_ < number; ++next_) imager_->skip();
  ++next_;
  last_ = frame;
  imager_->expose(converted_.front(), frame_);
  imager_->encode(frame_);
  return frame_;
}

void LiveClip::check(const Passes& passes) const {
  if (!passes.fine.x_px.empty()) return;
  const auto [width_px, height_px] = size_of_planes(manifest_);
  const auto check_plane = [&, width = width_px, height = height_px](const auto& plane, const char* name,
                                                                     bool needed) {
    if (plane.empty() && !needed) return;
    if (plane.width_px() == width && plane.height_px() == height) return;
    throw DataError(fault(name, fmt::format("{} x {}", plane.width_px(), plane.height_px()), "px",
                          fmt::format("{} x {}, as the manifest's passes have", width, height)));
  };
  const PassNeeds needed = needs();
  check_plane(passes.object_index, "object_index", true);
  check_plane(passes.material_index, "material_index", false);
  check_plane(passes.actor_index, "actor_index", needed.actors);
  check_plane(passes.depth_m, "depth_m", needed.depth);
  for (const Plane<float>& axis : passes.normal) check_plane(axis, "normal", needed.normals);
}

std::unique_ptr<LiveClip> live_clip_of(Manifest manifest, const Passes& first,
                                       const ConvertOptions& options) {
  const std::vector<ClipPasses> sources = {{.manifest = manifest, .folder = "manifest"}};
  const DatasetSpec spec = convert_requests(options, sources).front().config.spec;
  auto materials = std::make_shared<const MaterialLibrary>(read_materials(options.assets));
  const KeptTerms kept(spec, outline_of(spec, *materials, sources, {view_planes(manifest, first)}));
  HeatDays heat(*materials);
  const ClipSpec& clip = spec.clips.front();
  ClipTask task = task_of(spec, clip, kept.of(clip), heat, nullptr);
  return std::make_unique<LiveClip>(std::move(manifest), std::move(materials), std::move(task));
}

}  // namespace thermal
