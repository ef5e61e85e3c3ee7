#include "imaging/surfaces.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

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

SurfaceMap::SurfaceMap(const Manifest& manifest, const MaterialLibrary& materials,
                       const ActorClasses& classes)
    : by_object_(kIndexValues),
      by_material_(kIndexValues),
      known_objects_(kIndexValues),
      known_materials_(kIndexValues) {
  known_objects_[kSkyIndex] = true;
  by_object_[kSkyIndex] = add(materials.find("sky", "material of index 0"), "");
  for (const ManifestObject& object : manifest.objects) {
    const Material& material =
        materials.find(object.material, fmt::format("object {}: material", object.name));
    by_object_[object.index] = add(material, "");
    known_objects_[object.index] = true;
  }
  known_materials_[0] = true;
  for (const ManifestMaterial& entry : manifest.materials) {
    const Material& material = materials.find(entry.material, fmt::format("material index {}", entry.index));
    by_material_[entry.index] = add(material, entry.part);
    known_materials_[entry.index] = true;
  }
  if (classes.count > 1) add_classes(classes);
}

void SurfaceMap::add_classes(const ActorClasses& classes) {
  const std::vector<Surface> first = surfaces_;
  for (std::uint8_t number = 1; number < classes.count; ++number) {
    for (Surface surface : first) {
      surface.actor_class = number;
      surfaces_.push_back(std::move(surface));
    }
  }
  class_shift_.resize(kIndexValues);
  for (std::size_t index = 0; index < classes.of_object.size(); ++index)
    class_shift_[index] = static_cast<std::uint16_t>(classes.of_object[index] * first.size());
}

std::uint16_t SurfaceMap::add(const Material& material, const std::string& part) {
  const Surface surface = {.material = &material, .part = part, .actor_class = 0};
  const auto found = std::find(surfaces_.begin(), surfaces_.end(), surface);
  const auto number = static_cast<std::uint16_t>(found - surfaces_.begin());
  if (found == surfaces_.end()) surfaces_.push_back(surface);
  return number;
}

void SurfaceMap::check_objects(std::span<const IndexUse> uses) const {
  check_known(uses, known_objects_, "object index", "objects");
}

void SurfaceMap::check_materials(std::span<const IndexUse> uses) const {
  check_known(uses, known_materials_, "material index", "materials");
}

void SurfaceMap::number(std::span<const std::uint16_t> objects, std::span<const std::uint16_t> materials,
                        std::span<std::uint16_t> surfaces) const noexcept {
  if (materials.empty()) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) surfaces[i] = by_object_[objects[i]];
  } else {
    for (std::size_t i = 0; i < surfaces.size(); ++i)
      surfaces[i] = materials[i] != 0 ? by_material_[materials[i]] : by_object_[objects[i]];
  }
  if (class_shift_.empty()) return;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    surfaces[i] = static_cast<std::uint16_t>(surfaces[i] + class_shift_[objects[i]]);
}

}  // namespace thermal
