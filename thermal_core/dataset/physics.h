#pragma once

#include <optional>
#include <vector>

#include "imaging/budget.h"
#include "imaging/scene_radiance.h"
#include "io/config.h"
#include "scene/manifest.h"

namespace thermal {

/// What a config's pictures will hold: its ground, plants and species, and where its clips look from.
/// Shares of the pictures are estimates from densities and sizes; actors together count for 3 %.
[[nodiscard]] SceneOutline outline_of(const Config& config, const MaterialLibrary& materials,
                                      const Path& home);

/// The same from manifests, for passes whose scene no config describes; `materials` must outlive it.
[[nodiscard]] SceneOutline outline_of(const Config& config, const MaterialLibrary& materials,
                                      const std::vector<const Manifest*>& manifests);

/// Physics of one clip with the terms a dataset keeps; nothing for the published model.
[[nodiscard]] std::optional<PhysicsSettings> physics_of(const Config& config, const ClipConfig& clip,
                                                        const Terms& terms);

/// What dataset.json says of the terms: the budget of a physical dataset, emission alone for the published model.
[[nodiscard]] Json to_json(const Budget& budget);

}  // namespace thermal
