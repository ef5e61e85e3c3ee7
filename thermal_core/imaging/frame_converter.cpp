#include "imaging/frame_converter.h"

namespace thermal {

FrameConverter::FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                               const SensorParameters& parameters)
    : scene_radiance_(manifest, materials, season, radiance_of(parameters.radiance)),
      brightest_w_m2_sr_(parameters.normalisation == Normalisation::table_max
                             ? brightest_of_table_1(materials, season, radiance_of(parameters.radiance))
                             : scene_radiance_.brightest_w_m2_sr()) {
  for (const ManifestObject& object : manifest.objects) {
    if (object.object_class == ObjectClass::actor) actor_indices_.push_back(object.index);
  }
}

SceneFrame FrameConverter::convert(const Passes& passes) const {
  const std::vector<IndexUse> uses = survey_indices(passes.object_index);
  scene_radiance_.check_objects(uses);
  if (!passes.material_index.empty()) scene_radiance_.check_materials(survey_indices(passes.material_index));
  return {.radiance_w_m2_sr = scene_radiance_.radiance(passes),
          .instances = extract_instances(passes.object_index, uses, actor_indices_)};
}

}  // namespace thermal
