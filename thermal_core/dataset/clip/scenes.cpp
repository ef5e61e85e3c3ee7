#include "dataset/clip/scenes.h"

#include <algorithm>
#include <utility>

#include "sensor/thermal_camera.h"

namespace thermal {

std::size_t ClipScenes::add(const ClipTask& task) {
  SceneSettings settings =
      scene_settings(task.clip.season, task.settings().sensor, task.physics, task.settings().distortion);
  const auto found = std::find_if(scenes_.begin(), scenes_.end(),
                                  [&](const Scene& scene) { return scene.settings == settings; });
  if (found != scenes_.end()) return static_cast<std::size_t>(found - scenes_.begin());
  FrameConverter converter(manifest_, materials_, settings);
  std::optional<MotionFinder> motion;
  if (settings.physics && settings.physics->terms.smear) motion.emplace(manifest_, settings.lens);
  scenes_.push_back(
      {.settings = std::move(settings), .converter = std::move(converter), .motion = std::move(motion)});
  return scenes_.size() - 1;
}

PassNeeds ClipScenes::needs() const {
  PassNeeds all;
  for (const Scene& scene : scenes_) {
    const PassNeeds needs = scene.converter.needs();
    all = {.depth = all.depth || needs.depth || scene.motion,
           .normals = all.normals || needs.normals,
           .actors = all.actors || needs.actors,
           .mirrored = all.mirrored || needs.mirrored,
           .depth_if_there = all.depth_if_there || needs.depth_if_there};
  }
  return all;
}

std::shared_ptr<const TemperatureTable> ClipScenes::temperatures(const SpectralResponse& response) {
  const auto found = std::find_if(temperatures_.begin(), temperatures_.end(),
                                  [&](const Temperatures& made) { return made.response == response; });
  if (found != temperatures_.end()) return found->table;
  return temperatures_.emplace_back(Temperatures{response, apparent_temperatures(response)}).table;
}

void ClipScenes::convert(const Passes& passes, int number, std::vector<SceneFrame>& out) const {
  out.resize(scenes_.size());
  const ManifestFrame& frame = manifest_.frames[static_cast<std::size_t>(number)];
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    scenes_[i].converter.convert(passes, frame, out[i]);
    if (scenes_[i].motion) scenes_[i].motion->find(passes, number, out[i].motion);
  }
}

void ClipScenes::convert(const Passes& passes, const ManifestFrame& frame, const ManifestFrame* before,
                         std::vector<SceneFrame>& out) const {
  out.resize(scenes_.size());
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    scenes_[i].converter.convert(passes, frame, out[i]);
    out[i].motion = {};
    if (scenes_[i].motion && before != nullptr)
      scenes_[i].motion->find(passes, *before, frame, out[i].motion);
  }
}

}  // namespace thermal
