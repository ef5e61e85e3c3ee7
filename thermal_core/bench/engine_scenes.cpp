#include "bench/engine_scenes.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "bench/measure.h"
#include "dataset/dataset_file.h"
#include "io/exr/passes.h"
#include "io/json/file.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

/// The last clip of a config with few frames, from another height and angle.
Json view(const Json& document, const char* id, double altitude_m, double look_angle_deg) {
  Json clip = document.at("clips").back();
  clip["id"] = id;
  clip["frames"] = kEngineFrames;
  clip["flight"]["altitude_m"] = altitude_m;
  clip["flight"]["look_angle_deg"] = look_angle_deg;
  return clip;
}

void multiply_plants(Json& document, double factor) {
  for (Json& plant : document["scene"]["plants"]) {
    Json& density = plant["per_ha"];
    if (!density.is_array()) density = Json::array({density, density, density});  // open, mid and dense areas
    for (Json& one : density) one = factor * one.get<double>();
  }
}

class Planner {
 public:
  explicit Planner(const EngineScenesTask& task) : task_(task) {}

  [[nodiscard]] Json document(const char* name) const {
    const Path file = task_.assets.config(name);
    return resolve_config(read_json(file), file.string(), task_.assets).document;
  }

  [[nodiscard]] EngineScene planned(const char* name, Json document, std::vector<EngineClip> clips) const {
    task_.announce(std::string(name) + ", planning");
    const Path plan = task_.folder / name;
    document["scene"]["temperatures"] = "table_1";  // needs no maps of the ground
    const ResolvedConfig config = resolve_config(std::move(document), name, task_.assets);
    const PlanOptions options = {.assets = task_.assets, .threads = task_.threads};
    return {.name = name,
            .plan = plan,
            .planned = PlanStore(plan, task_.assets).plan(config, name, options),
            .clips = std::move(clips)};
  }

 private:
  const EngineScenesTask& task_;
};

}  // namespace

std::vector<EngineScene> plan_engine_scenes(const EngineScenesTask& task) {
  const Planner planner(task);
  Json demo = planner.document("demo");
  demo["clips"] = {demo.at("clips").back()};
  demo["clips"][0]["id"] = "demo";
  demo["clips"][0]["frames"] = kEngineFrames;
  Json savanna = planner.document("savanna");
  const Json oblique = view(savanna, "oblique", 122, 45);
  savanna["clips"] = {view(savanna, "down", 61, 90), oblique, view(savanna, "horizon", 61, 8)};
  Json dense = savanna;
  multiply_plants(dense, 10);
  dense["clips"] = Json::array({oblique});
  std::vector<EngineScene> scenes;
  scenes.push_back(planner.planned("demo", std::move(demo), {{"demo", "demo"}}));
  scenes.push_back(planner.planned(
      "savanna", std::move(savanna),
      {{"down", "savanna 61 m down"}, {"oblique", "savanna 122 m oblique"}, {"horizon", "savanna horizon"}}));
  scenes.push_back(
      planner.planned("savanna x 10 plants", std::move(dense), {{"oblique", "savanna x 10 plants"}}));
  return scenes;
}

namespace {

constexpr PassNeeds kNeeds = {.depth = true, .normals = true};  // the planes that Blender renders

double differing_pixels(const Plane<std::uint16_t>& one, const Plane<std::uint16_t>& other) {
  if (one.size() != other.size()) throw DataError("Blender's frames have another size or lack a plane");
  double count = 0;
  for (std::size_t k = 0; k < one.size(); ++k) count += one.pixels()[k] != other.pixels()[k] ? 1 : 0;
  return count;
}

void add(double pixels, DifferingPixels& to) {
  to.mean += pixels / kEngineFrames;
  to.most = std::max(to.most, pixels);
}

CameraIntrinsics camera_of(const BakedScene& scene) {
  Manifest manifest;
  manifest.camera = scene.camera;
  manifest.overscan_px = scene.view_margin_px;
  return pixels_camera(manifest);
}

}  // namespace

double frame_time_s(const ClipTracer& tracer, std::size_t frames, Passes& out) {
  tracer.trace(0, kNeeds, out);
  double sum_s = 0;
  for (std::size_t frame = 1; frame < frames; ++frame)
    sum_s += middle_run_s([&] { tracer.trace(frame, kNeeds, out); });
  return sum_s / static_cast<double>(frames - 1);
}

EmbreeScene::EmbreeScene(const EngineScene& of, const Assets& assets)
    : spec_(of.planned.config.spec),
      store_(of.plan, assets),
      scene_(store_.scene(spec_)),
      caster_(scene_),
      camera_(camera_of(scene_)) {}

BakedTrack EmbreeScene::track(const std::string& clip) const {
  return store_.track(spec_.clip(clip, "clips"), scene_);
}

std::size_t EmbreeScene::plants() const noexcept {
  std::size_t plants = 0;
  for (const BakedPlants& species : scene_.plants) plants += species.mesh.size();
  return plants;
}

double EmbreeScene::pixels() const noexcept {
  return static_cast<double>(camera_.width_px) * static_cast<double>(camera_.height_px);
}

EmbreeTimes EmbreeScene::times(const std::string& clip, int supersample) const {
  const BakedTrack frames = track(clip);
  Passes out;
  EmbreeTimes times;
  times.full_s = frame_time_s({caster_, frames, camera_, {.supersample = supersample}}, kEngineFrames, out);
  times.adaptive_s = times.full_s;
  if (supersample == 1) return times;
  const ClipTracer adaptive(caster_, frames, camera_, {.supersample = supersample, .adaptive = true});
  times.adaptive_s = frame_time_s(adaptive, kEngineFrames, out);
  times.all_rays_share = 0;
  for (std::size_t frame = 1; frame < kEngineFrames; ++frame) {
    adaptive.trace(frame, kNeeds, out);
    times.all_rays_share += static_cast<double>(out.fine.x_px.size()) / pixels() / (kEngineFrames - 1);
  }
  return times;
}

Differing EmbreeScene::differing(const std::string& clip, const Path& blenders) const {
  const BakedTrack frames = track(clip);
  const ClipTracer tracer(caster_, frames, camera_);
  Passes own;
  Differing differing{.pixels = pixels(), .object = {}, .material = {}};
  for (int frame = 0; frame < kEngineFrames; ++frame) {
    const Passes others = read_passes(blenders / passes_name(frame), {.layer = "Scene"}, {});
    tracer.trace(static_cast<std::size_t>(frame), {}, own);
    add(differing_pixels(own.object_index, others.object_index), differing.object);
    add(differing_pixels(own.material_index, others.material_index), differing.material);
  }
  return differing;
}

}  // namespace thermal
