#include "analysis/fit/stored_radiance.h"

#include <algorithm>
#include <utility>

#include "analysis/compare/frame_source.h"
#include "base/error.h"
#include "base/order_statistics.h"
#include "base/parallel.h"
#include "dataset/clip/imager.h"
#include "dataset/clip/scenes.h"
#include "dataset/clip/task.h"
#include "dataset/outline/outline.h"
#include "dataset/run/tracing.h"
#include "io/config/materials.h"
#include "labels/instances.h"

namespace thermal {
namespace {

std::vector<LabelBox> boxes_of(const std::vector<Instance>& instances, const Manifest& manifest,
                               const LabelParameters& parameters, const TargetChoice& targets) {
  std::vector<LabelBox> boxes;
  for (const Instance& instance : instances) {
    const auto actor = std::ranges::find(manifest.objects, instance.index, &ManifestObject::index);
    if (actor == manifest.objects.end() || !is_requested(actor->category, targets.category)) continue;
    if (is_ignored(instance, parameters)) continue;
    LabelBox box = {.x_px = static_cast<double>(instance.box.x_px),
                    .y_px = static_cast<double>(instance.box.y_px),
                    .width_px = static_cast<double>(instance.box.width_px),
                    .height_px = static_cast<double>(instance.box.height_px)};
    if (targets.boxes == BoxStyle::drawn)
      box = drawn_box(box, manifest.camera.width_px, manifest.camera.height_px);
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

void check_can_be_exposed(const DatasetSpec& spec, const std::string& name) {
  if (!spec.physical)
    throw ConfigError(
        fault(name + ": sensor.model", "\"published\"", "",
              "physical, or a preset of a camera: the published model has nothing of what is fitted"));
  if (spec.engine != Engine::embree)
    throw ConfigError(fault(name + ": render.engine", "\"blender\"", "", "\"embree\" or \"auto\""));
}

StoredRadiance::StoredRadiance(const PlannedDataset& planned, const PlanStore& store, std::size_t most_clips,
                               const Assets& assets, const RunHooks& hooks) {
  const DatasetSpec& spec = planned.config.spec;
  const MaterialLibrary materials = read_materials(assets);
  HeatDays heat(materials);
  const KeptTerms kept(spec, outline_of(spec, planned.plan, materials));
  const PlanTracer tracer(store, spec);
  const auto ground = store.ground_maps(spec, tracer.scene());
  const std::vector<std::size_t> chosen = evenly(spec.clips.size(), most_clips);
  Progress progress;
  for (const std::size_t k : chosen) progress.total += spec.clips[k].frames;
  for (const std::size_t k : chosen) {
    const ClipSpec& clip = spec.clips[k];
    ClipPasses passes = tracer.trace(clip, {}, false);
    ClipScenes scenes(passes.manifest, materials);
    Clip stored = {.place = k,
                   .manifest = {},
                   .task = task_of(spec, clip, kept.of(clip), heat, ground),
                   .temperatures = {},
                   .frames = std::vector<SceneFrame>(static_cast<std::size_t>(clip.frames))};
    const std::size_t scene = scenes.add(stored.task);
    stored.brightest_w_m2_sr = scenes.brightest_w_m2_sr(scene);
    stored.temperatures = scenes.temperatures(clip.settings->sensor.response);
    progress.clip = clip.id;
    for (int frame = 0; frame < clip.frames; ++frame) {
      if (hooks.stop_wanted()) throw Cancelled();
      Passes planes;
      std::vector<SceneFrame> converted;
      passes.source->read(frame, scenes.needs(), planes);
      scenes.convert(planes, frame, converted);
      stored.frames[static_cast<std::size_t>(frame)] = std::move(converted.front());
      ++progress.done;
      hooks.report(progress);
    }
    stored.manifest = std::move(passes.manifest);
    clips_.push_back(std::move(stored));
  }
}

std::vector<FrameFigures> StoredRadiance::measured(const DatasetSpec& spec,
                                                   const TargetChoice& targets) const {
  std::vector<std::vector<FrameFigures>> by_clip(clips_.size());
  parallel_for(clips_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      by_clip[k] = measured(clips_[k], *spec.clips[clips_[k].place].settings, targets);
  });
  std::vector<FrameFigures> all;
  for (std::size_t clip = 0; clip < by_clip.size(); ++clip) {
    for (FrameFigures& frame : by_clip[clip]) {
      frame.frame = all.size();
      frame.unit = clip;
      all.push_back(std::move(frame));
    }
  }
  return all;
}

std::vector<FrameFigures> StoredRadiance::measured(const Clip& clip, const ClipSettings& settings,
                                                   const TargetChoice& targets) {
  auto exposed = std::make_shared<ClipSettings>(clip.task.settings());
  exposed->sensor = settings.sensor;
  exposed->link = settings.link;
  exposed->codec = settings.codec;
  ClipTask task = clip.task;
  task.clip.settings = exposed;
  ClipImager imager(task, clip.manifest, clip.brightest_w_m2_sr, clip.temperatures);
  ClipImager::Frame frame;
  std::vector<FrameFigures> found;
  for (const SceneFrame& scene : clip.frames) {
    imager.expose(scene, frame);
    imager.encode(frame);
    const Plane<std::uint8_t>& picture = frame.pictures.ir8;
    Plane<float> levels(picture.width_px(), picture.height_px());
    std::ranges::copy(picture.pixels(), levels.pixels().begin());
    found.push_back(
        measure_frame(levels, boxes_of(scene.instances, clip.manifest, exposed->labels, targets)));
  }
  return found;
}

}  // namespace thermal
