#include "imaging/frame_converter.h"

#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "imaging/supersample.h"
#include "sensor/thermal_camera.h"

namespace thermal {
namespace {

SceneRadiance make_scene(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                         const SensorParameters& parameters, const std::optional<PhysicsSettings>& physics) {
  if (!physics) return {manifest, materials, season, radiance_of(parameters)};
  return {manifest, materials, *physics};
}

std::shared_ptr<const ResampleMap> make_map(const Manifest& manifest, const LensDistortion& lens) {
  const int needed_px = overscan_px(manifest.camera, lens);
  if (manifest.overscan_px < needed_px) {
    throw ConfigError(fault(
        fmt::format("clip {}: overscan_px", manifest.clip), fmt::format("{}", manifest.overscan_px), "px",
        fmt::format("at least {} px for this lens distortion (render.overscan_px), or a manifest "
                    "whose camera is smaller than its passes",
                    needed_px)));
  }
  if (lens.is_none() && manifest.overscan_px == 0) return nullptr;
  return std::make_shared<const ResampleMap>(manifest.camera, manifest.overscan_px, lens);
}

}  // namespace

FrameConverter::FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                               const SensorParameters& parameters,
                               const std::optional<PhysicsSettings>& physics, const LensDistortion& lens)
    : supersample_(manifest.supersample),
      map_(make_map(manifest, lens)),
      scene_radiance_(make_scene(manifest, materials, season, parameters, physics)),
      brightest_w_m2_sr_(parameters.agc.mode == AgcMode::table_max
                             ? brightest_of_table_1(materials, season, radiance_of(parameters))
                             : scene_radiance_.brightest_w_m2_sr()),
      labeller_(manifest, lens, map_, scene_radiance_.needs().depth),
      has_actor_layer_(!manifest.actor_layer.empty()) {}

PassNeeds FrameConverter::needs() const noexcept {
  PassNeeds needs = scene_radiance_.needs();
  needs.actors = has_actor_layer_;
  return needs;
}

SceneFrame FrameConverter::convert(const Passes& passes, const ManifestFrame& frame) const {
  SceneFrame scene;
  convert(passes, frame, scene);
  return scene;
}

void FrameConverter::convert(const Passes& passes, const ManifestFrame& frame, SceneFrame& out) const {
  const std::vector<IndexUse> uses = survey_indices(passes.object_index);
  const SurfaceMap& surfaces = scene_radiance_.surfaces();
  surfaces.check_objects(uses);
  if (!passes.material_index.empty()) surfaces.check_materials(survey_indices(passes.material_index));
  out.instances = labeller_.label(passes, uses, frame);
  if (supersample_ == 1 && !map_) {
    scene_radiance_.radiance(passes, frame, out.radiance_w_m2_sr);
  } else {
    reshape(scene_radiance_.radiance(passes, frame), out.radiance_w_m2_sr);
  }
}

/// From the passes' pixels to the camera's.
void FrameConverter::reshape(Plane<float> fine, Plane<float>& out) const {
  Plane<float> radiance = supersample_ > 1 ? block_means(fine, supersample_) : std::move(fine);
  if (map_) {
    map_->resample_linear(radiance, out);
  } else {
    out = std::move(radiance);
  }
}

}  // namespace thermal
