#include "imaging/frame_converter.h"

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

std::optional<ResampleMap> make_map(const Manifest& manifest, const LensDistortion& lens) {
  const int needed_px = overscan_px(manifest.camera, lens);
  if (manifest.overscan_px < needed_px) {
    throw ConfigError(fault(
        fmt::format("clip {}: overscan_px", manifest.clip), fmt::format("{}", manifest.overscan_px), "px",
        fmt::format("at least {} px for this lens distortion (render.overscan_px), or a manifest "
                    "whose camera is smaller than its passes",
                    needed_px)));
  }
  if (lens.is_none() && manifest.overscan_px == 0) return std::nullopt;
  return ResampleMap(manifest.camera, manifest.overscan_px, lens);
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
                             : scene_radiance_.brightest_w_m2_sr()) {
  for (const ManifestObject& object : manifest.objects) {
    if (object.object_class == ObjectClass::actor) actor_indices_.push_back(object.index);
  }
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
  if (supersample_ > 1 || map_) return convert_reshaped(passes, frame, out);
  scene_radiance_.radiance(passes, frame, out.radiance_w_m2_sr);
  out.instances = extract_instances(passes.object_index, uses, actor_indices_);
}

void FrameConverter::convert_reshaped(const Passes& passes, const ManifestFrame& frame,
                                      SceneFrame& out) const {
  Plane<float> radiance = scene_radiance_.radiance(passes, frame);
  Plane<std::uint16_t> coarse;
  const Plane<std::uint16_t>* indices = &passes.object_index;
  if (supersample_ > 1) {
    radiance = block_means(radiance, supersample_);
    coarse = block_actors(passes.object_index, supersample_, actor_indices_);
    indices = &coarse;
  }
  if (map_) {
    map_->resample_linear(radiance, out.radiance_w_m2_sr);
    coarse = map_->resample_nearest(*indices);
  } else {
    out.radiance_w_m2_sr = std::move(radiance);
  }
  out.instances = extract_instances(coarse, survey_indices(coarse), actor_indices_);
}

}  // namespace thermal
