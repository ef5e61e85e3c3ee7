#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dataset/plan/plan.h"
#include "dataset/run/progress.h"
#include "heat/weather/sun.h"
#include "io/assets.h"
#include "io/config/config.h"
#include "scene/ground_maps.h"
#include "scene/seen_ground.h"

namespace thermal {

/// Whether a plan of this config has maps of the ground: the heat balance of the physical model needs them.
[[nodiscard]] bool needs_ground_maps(const Config& config);

/// The days whose sun heats the ground of a config's clips and flights, each once.
[[nodiscard]] std::vector<SunPath> sun_paths(const Config& config);

/// Whether the maps in a plan's folder, if there are any, serve this config, or it needs none.
[[nodiscard]] bool has_needed_ground_maps(const Path& folder, const Config& config, const Assets& assets);

/// Whether a plan's folder has maps of the ground, and this config's temperatures need them.
[[nodiscard]] bool uses_ground_maps(const Path& folder, const Config& config);

/// Those maps; null without any, or if this config's temperatures need none. Errors as read_baked_scene() and
/// read_ground_maps().
[[nodiscard]] std::shared_ptr<const GroundMaps> read_needed_ground_maps(const Path& folder,
                                                                        const Config& config,
                                                                        const Assets& assets);

/// What the clips of the plan in a folder show, with all that a lens or overscan adds. Errors as read_baked_track().
[[nodiscard]] std::vector<GroundView> ground_views(const Path& folder, const DatasetPlan& plan,
                                                   const BakedScene& scene, const Assets& assets);

/// Makes the maps of the scene in a plan's folder, on all cores, and writes them there: light where its clips may see the
/// ground or, where cameras may fly anywhere (render.posed_actors "all"), everywhere. `scratch` is a folder on the same
/// disk. Errors as read_baked_scene(), read_baked_track() and write_ground_maps().
void add_ground_maps(const Path& folder, const Path& scratch, const Config& config, const DatasetPlan& plan,
                     const Assets& assets, const std::function<void(const Progress&)>& show);

}  // namespace thermal
