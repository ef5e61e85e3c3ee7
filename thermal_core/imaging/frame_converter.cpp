#include "imaging/frame_converter.h"

#include "imaging/supersample.h"

namespace thermal {
namespace {

SceneRadiance make_scene(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                         const SensorParameters& parameters, const std::optional<PhysicsSettings>& physics) {
  if (!physics) return {manifest, materials, season, radiance_of(parameters)};
  return {manifest, materials, *physics};
}

}  // namespace

FrameConverter::FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                               const SensorParameters& parameters,
                               const std::optional<PhysicsSettings>& physics)
    : supersample_(manifest.supersample),
      scene_radiance_(make_scene(manifest, materials, season, parameters, physics)),
      brightest_w_m2_sr_(parameters.normalisation == Normalisation::table_max
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
  if (supersample_ == 1) {
    scene_radiance_.radiance(passes, frame, out.radiance_w_m2_sr);
    out.instances = extract_instances(passes.object_index, uses, actor_indices_);
    return;
  }
  const Plane<std::uint16_t> actors = block_actors(passes.object_index, supersample_, actor_indices_);
  out.radiance_w_m2_sr = block_means(scene_radiance_.radiance(passes, frame), supersample_);
  out.instances = extract_instances(actors, survey_indices(actors), actor_indices_);
}

}  // namespace thermal
