#pragma once

#include <optional>
#include <vector>

#include "imaging/budget.h"
#include "imaging/scene_radiance.h"
#include "io/config.h"
#include "scene/manifest.h"

namespace thermal {

/// Physics of one clip with the terms a dataset keeps; empty for the published model.
[[nodiscard]] std::optional<PhysicsSettings> physics_of(const Config& config, const ClipConfig& clip,
                                                        const Terms& terms);

/// The entry of dataset.json on terms: the budget of a physical dataset, emission alone for the published model.
[[nodiscard]] Json to_json(const Budget& budget);

}  // namespace thermal
