#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "labels/instances.h"
#include "scene/manifest.h"
#include "scene/material.h"
#include "scene/passes.h"

namespace thermal {

/// A kind of surface of a manifest: a material, or a part of one, on actors of one class.
struct Surface {
  const Material* material = nullptr;
  std::string part;
  std::uint8_t actor_class = 0;

  [[nodiscard]] bool operator==(const Surface&) const = default;
};

/// Classes of actors by state, which have separate surfaces: by object index, below `count`; objects beyond the list
/// are of class 0.
struct ActorClasses {
  std::vector<std::uint8_t> of_object;
  std::uint8_t count = 1;
};

/// Maps pixels of index planes to surfaces. A pixel has the material of its material index; where that is 0 or there is
/// no material plane, the material of its object. Object index 0 is the material "sky".
class SurfaceMap {
 public:
  static constexpr std::uint16_t kSky = 0;  ///< the number of the sky among surfaces()

  /// ConfigError if a material of the manifest is not in the library, which must outlive this object.
  SurfaceMap(const Manifest& manifest, const MaterialLibrary& materials, const ActorClasses& classes = {});

  /// All possible surfaces, each once; the sky first, those of class 1 after all of class 0, and so on.
  [[nodiscard]] const std::vector<Surface>& surfaces() const noexcept { return surfaces_; }

  /// DataError with the first pixel whose index the manifest lacks.
  void check_objects(std::span<const IndexUse> uses) const;
  void check_materials(std::span<const IndexUse> uses) const;

  /// Surface number of each pixel of one row. All indices must be known; check them first.
  /// `materials` is empty without a material plane.
  void number(std::span<const std::uint16_t> objects, std::span<const std::uint16_t> materials,
              std::span<std::uint16_t> surfaces) const noexcept;

 private:
  std::uint16_t add(const Material& material, const std::string& part);
  void add_classes(const ActorClasses& classes);

  std::vector<Surface> surfaces_;
  std::vector<std::uint16_t> by_object_;  ///< by object index; valid only where known_
  std::vector<std::uint16_t> by_material_;
  std::vector<std::uint16_t>
      class_shift_;  ///< by object index: added to the number; empty if there is one class
  std::vector<bool> known_objects_;
  std::vector<bool> known_materials_;
};

}  // namespace thermal
