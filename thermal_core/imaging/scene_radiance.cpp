#include "imaging/scene_radiance.h"

#include <algorithm>
#include <cassert>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

constexpr std::size_t kIndices = kLargestIndex + 1;

/// As the planes hold it, so that the brightest material's pixels are exactly the brightest count.
float emitted(const Material& material, Season season, const SceneRadiance::RadianceOf& radiance_of) {
  return static_cast<float>(material.emissivity * radiance_of(material.temperature_k(season)));
}

void check_known(std::span<const IndexUse> uses, const std::vector<bool>& known, std::string_view plane,
                 std::string_view list) {
  for (const IndexUse& use : uses) {
    if (known[use.index]) continue;
    std::vector<std::string> names;
    for (std::size_t index = 0; index < known.size(); ++index) {
      if (known[index]) names.push_back(fmt::format("{}", index));
    }
    throw DataError(
        fmt::format("{} at pixel ({}, {}) = {} ({} pixels); expected an index of the manifest's {}: {}",
                    plane, use.first_x_px, use.first_y_px, use.index, use.pixels, list, list_names(names)));
  }
}

}  // namespace

SceneRadiance::SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                             const RadianceOf& radiance_of)
    : by_object_(kIndices), by_material_(kIndices), known_objects_(kIndices), known_materials_(kIndices) {
  const auto radiance_named = [&](const std::string& name, const std::string& where) {
    return emitted(materials.find(name, where), season, radiance_of);
  };
  known_objects_[kSkyIndex] = true;
  by_object_[kSkyIndex] = radiance_named("sky", "material of index 0");
  for (const ManifestObject& object : manifest.objects) {
    const float value = radiance_named(object.material, fmt::format("object {}: material", object.name));
    by_object_[object.index] = value;
    known_objects_[object.index] = true;
    brightest_w_m2_sr_ = std::max(brightest_w_m2_sr_, value);
  }
  known_materials_[0] = true;
  for (const ManifestMaterial& material : manifest.materials) {
    const float value = radiance_named(material.material, fmt::format("material index {}", material.index));
    by_material_[material.index] = value;
    known_materials_[material.index] = true;
    brightest_w_m2_sr_ = std::max(brightest_w_m2_sr_, value);
  }
  if (brightest_w_m2_sr_ == 0) brightest_w_m2_sr_ = by_object_[kSkyIndex];
}

void SceneRadiance::check_objects(std::span<const IndexUse> uses) const {
  check_known(uses, known_objects_, "object index", "objects");
}

void SceneRadiance::check_materials(std::span<const IndexUse> uses) const {
  check_known(uses, known_materials_, "material index", "materials");
}

Plane<float> SceneRadiance::radiance(const Passes& passes) const {
  const auto objects = passes.object_index.pixels();
  const auto materials = passes.material_index.pixels();
  Plane<float> plane(passes.object_index.width_px(), passes.object_index.height_px());
  const auto out = plane.pixels();
  if (materials.empty()) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = by_object_[objects[i]];
    return plane;
  }
  assert(materials.size() == objects.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = materials[i] != 0 ? by_material_[materials[i]] : by_object_[objects[i]];
  }
  return plane;
}

float brightest_of_table_1(const MaterialLibrary& materials, Season season,
                           const SceneRadiance::RadianceOf& radiance_of) {
  float brightest = 0;
  for (const auto& [name, material] : materials.all()) {
    if (material.in_table_1) brightest = std::max(brightest, emitted(material, season, radiance_of));
  }
  return brightest;
}

}  // namespace thermal
