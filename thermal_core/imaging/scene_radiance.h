#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/image.h"
#include "labels/instances.h"
#include "scene/manifest.h"
#include "scene/material.h"
#include "scene/passes.h"
#include "scene/season.h"

namespace thermal {

/// Radiance of everything a clip's manifest names, direct emission only: emissivity * L(temperature).
/// A pixel takes the material of its material index; where that is 0 or there is no material plane, the
/// material of its object. Object index 0 is the material "sky".
class SceneRadiance {
 public:
  using RadianceOf = std::function<double(double temperature_k)>;

  /// ConfigError if a material of the manifest is not in the library.
  SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                const RadianceOf& radiance_of);

  /// DataError naming the first pixel whose index the manifest lacks. `what` names the plane's meaning.
  void check_objects(std::span<const IndexUse> uses) const;
  void check_materials(std::span<const IndexUse> uses) const;

  /// Index planes to radiance plane [W m^-2 sr^-1]. All indices must be known: check them first.
  [[nodiscard]] Plane<float> radiance(const Passes& passes) const;

  /// Radiance of the most radiant material the manifest names; of the sky where it names none.
  [[nodiscard]] float brightest_w_m2_sr() const noexcept { return brightest_w_m2_sr_; }

 private:
  float brightest_w_m2_sr_ = 0;
  std::vector<float> by_object_;  ///< by object index; only known_ ones mean anything
  std::vector<float> by_material_;
  std::vector<bool> known_objects_;
  std::vector<bool> known_materials_;
};

/// Radiance of the most radiant of the rows of Table 1.
[[nodiscard]] float brightest_of_table_1(const MaterialLibrary& materials, Season season,
                                         const SceneRadiance::RadianceOf& radiance_of);

}  // namespace thermal
