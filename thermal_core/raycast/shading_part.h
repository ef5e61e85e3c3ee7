#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/baked_scene.h"
#include "scene/ground_maps.h"

namespace thermal {

/// Start of rays to the sky: squares of the ground's maps, and the lowest height.
struct RayStart {
  std::array<double, 2> low_m{};  ///< corners
  std::array<double, 2> high_m{};
  double height_m = 0;  ///< of the lowest ray's start
};

/// The part of a scene that rays from some starts to the sky can hit: ground, waters and plants, without whatever rises
/// by less than 1.5 degrees above the horizon of all starts, unless it can hide a sun as low as that. The parts left
/// out hide at most sin^2(1.5 deg) = 0.0007 of the sky of a level surface.
class ShadingPart {
 public:
  /// The scene must outlive this object.
  /// @param size_m  side of the square that the scene fills
  /// @param suns  directions; those below the horizon do not count
  ShadingPart(const BakedScene& scene, double size_m, std::span<const RayStart> starts,
              std::span<const EastNorthUp> suns);
  ShadingPart(const ShadingPart&) = delete;
  ShadingPart& operator=(const ShadingPart&) = delete;

  /// Without actors, objects, materials and normals.
  [[nodiscard]] const BakedScene& scene() const noexcept { return part_; }

 private:
  std::vector<std::vector<std::array<std::uint32_t, 3>>> triangles_;  ///< by surface
  std::vector<std::vector<Transform<double>>> transforms_;            ///< by species
  std::vector<std::vector<std::uint32_t>> plant_meshes_;
  BakedScene part_;
};

}  // namespace thermal
