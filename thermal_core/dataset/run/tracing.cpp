#include "dataset/run/tracing.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "dataset/clip/task.h"
#include "dataset/dataset_file.h"
#include "io/exr/passes_writer.h"
#include "io/manifest_file.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

/// The nearest decimal number.
double round_decimal(double value, int digits) {
  return number_in<double>(fmt::format("{:.{}f}", value, digits)).value_or(value);
}

/// The same of many numbers, faster: some differ in their last bit. Without negative zeros.
double round_scaled(double value, double scale) { return std::nearbyint(value * scale) / scale + 0.0; }

/// Where kept frames are written.
struct Kept {
  Path folder;
  std::string layer;
  std::string actor_layer;
};

class TracedPasses : public PassSource {
 public:
  TracedPasses(const RayCaster& caster, BakedTrack track, const CameraIntrinsics& camera,
               const Sampling& sampling, std::optional<Kept> kept)
      : track_(std::move(track)), tracer_(caster, track_, camera, sampling), kept_(std::move(kept)) {}

  void read(int frame, const PassNeeds& needs, Passes& out) const override {
    if (!kept_) {
      tracer_.trace(static_cast<std::size_t>(frame), needs, out);
      return;
    }
    tracer_.trace(static_cast<std::size_t>(frame),
                  {.depth = true, .normals = true, .actors = !kept_->actor_layer.empty(), .mirrored = true},
                  out);
    const Path file = kept_->folder / passes_name(frame);
    if (!std::filesystem::exists(file))
      write_passes(file, out, kept_->layer, kept_->actor_layer, ExrPacking::run_lengths);
  }

 private:
  BakedTrack track_;
  ClipTracer tracer_;
  std::optional<Kept> kept_;
};

}  // namespace

ManifestFrame manifest_frame_of(const BakedScene& scene, const BakedMoment& now, double time_s) {
  constexpr double kMicro = 1e6;
  constexpr double kNano = 1e9;
  ManifestFrame frame;
  frame.time_s = round_decimal(time_s, 9);
  frame.camera_to_world = now.camera_to_world;
  for (double& entry : *frame.camera_to_world) entry = round_scaled(entry, kNano);
  for (std::size_t actor = 0; actor < scene.actors.size(); ++actor) {
    ActorPose pose{.index = scene.actors[actor].object,
                   .position_m = now.actor_position_m[actor],
                   .heading_rad = round_decimal(now.actor_heading_rad[actor], 9)};
    for (double& coordinate_m : pose.position_m) coordinate_m = round_scaled(coordinate_m, kMicro);
    frame.actors.push_back(pose);
  }
  return frame;
}

Manifest manifest_of(const BakedScene& scene, const BakedTrack& track, const DatasetSpec& spec,
                     const ClipSpec& clip) {
  Manifest manifest;
  manifest.clip = clip.id;
  manifest.of_flight = clip.of_flight;
  manifest.scene = scene.name;
  manifest.seed = scene.seed;
  manifest.frame_rate_hz = clip.frame_rate_hz;
  manifest.layer = "Scene";
  if (spec.actor_layer) manifest.actor_layer = "Actors";
  manifest.camera = track.camera.value_or(scene.camera);
  manifest.supersample = spec.supersample;
  if (spec.engine == Engine::embree) {
    if (MirrorIndices(scene).any()) manifest.mirror_layer = kMirrorLayer;
    manifest.lens = clip.settings->distortion;
  } else {  // a pinhole's picture, to which conversion applies the lens, without rays beyond the water
    manifest.overscan_px = scene.view_margin_px;
  }
  manifest.objects = scene.objects;
  manifest.materials = scene.materials;
  manifest.beds = scene.beds;
  const TrackMoments moments(scene, track);
  for (std::size_t k = 0; k < track.frames; ++k) {
    ManifestFrame& frame =
        manifest.frames.emplace_back(manifest_frame_of(scene, moments.at_frame(k), track.time_s[k]));
    frame.file = passes_name(static_cast<int>(k));
    frame.agl_m = round_decimal(track.agl_m[k], 6);
    frame.look_angle_deg = round_decimal(track.look_angle_deg[k], 6);
  }
  return manifest;
}

PlanTracer::PlanTracer(PlanStore store, const DatasetSpec& spec)
    : store_(std::move(store)), spec_(spec), scene_(store_.scene(spec)), caster_(scene_) {}

ClipPasses PlanTracer::trace(const ClipSpec& clip, const Path& folder, bool keep) const {
  BakedTrack track = store_.track(clip, scene_);
  ClipPasses passes{.manifest = manifest_of(scene_, track, spec_, clip), .folder = folder};
  std::optional<Kept> kept;
  if (keep) {
    make_folder(folder);
    write_file_atomically(folder / "manifest.json", to_text(passes.manifest));
    kept = {.folder = folder, .layer = passes.manifest.layer, .actor_layer = passes.manifest.actor_layer};
  }
  const Sampling sampling = {
      .supersample = spec_.supersample, .adaptive = spec_.adaptive_sampling, .lens = passes.manifest.lens};
  passes.source = std::make_shared<TracedPasses>(caster_, std::move(track), passes.manifest.camera, sampling,
                                                 std::move(kept));
  return passes;
}

}  // namespace thermal
