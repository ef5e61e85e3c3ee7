#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dataset/plan/plan_store.h"
#include "dataset/progress.h"
#include "heat/weather/sun.h"
#include "io/assets.h"
#include "io/config/config.h"
#include "scene/ground_maps.h"
#include "scene/seen_ground.h"

namespace thermal {

/// How a plan is made.
struct PlanOptions {
  Assets assets;
  /// Work done at once, in processes; 0: thread_count(0). The plan does not depend on it.
  int threads = 0;
  Path blender = {};  ///< reads models of other programs; empty: there is none
  /// Called for each planned clip or flight; `clip` is its id.
  std::function<void(const Progress&)> show = {};
  /// The same for cells of the maps of the ground; `clip` is "ground maps".
  std::function<void(const Progress&)> show_maps = {};
  /// Also bakes what a preview needs.
  bool preview = false;
  /// Called if something temporary cannot be removed; the next planning into the same folder removes it.
  std::function<void(const LeftOver&)> left_over = {};
};

/// Plans a dataset by running blender_scripts/plan_scene.py, which does not need Blender: checks the meaning of a config
/// (paths, species, targets, the camera above ground), cuts its flights and plans its clips. Writes nothing.
/// ConfigError, starting with `name`, for an invalid config; IoError if Python or NumPy is missing.
[[nodiscard]] DatasetPlan plan_dataset(const ResolvedConfig& config, const std::string& name,
                                       const PlanOptions& options);

/// The same with the baked scene, the tracks of all clips and, if the config needs them, maps of the ground, in `folder`.
/// A plan that is already there is used again if nothing that it depends on has changed and none of its files is
/// damaged; maps that it lacks are added. Otherwise `may_replace` is called with the new one, which is still in
/// unfinished_plan(), and it takes the old one's place in one step unless that throws. Of two runs at once, one plans,
/// and the other waits for it.
[[nodiscard]] DatasetPlan plan_into(const Path& folder, const ResolvedConfig& config, const std::string& name,
                                    const PlanOptions& options,
                                    const std::function<void(const DatasetPlan&)>& may_replace = {});

/// Where the plan of this folder is made.
[[nodiscard]] Path unfinished_plan(const Path& folder);

/// The Python that runs the planning: $VELDT_PYTHON, /usr/bin/python3, or python3 on $PATH; empty if there is none.
[[nodiscard]] Path find_python();

/// Whether a plan of this config has maps of the ground: the heat balance of the physical model needs them.
[[nodiscard]] bool needs_ground_maps(const DatasetSpec& spec);

/// The days whose sun heats the ground of a config's clips and flights, each once.
[[nodiscard]] std::vector<SunPath> sun_paths(const DatasetSpec& spec);

/// Whether the maps in a plan's folder, if there are any, serve this config, or it needs none.
[[nodiscard]] bool has_needed_ground_maps(const Path& folder, const DatasetSpec& spec, const Assets& assets);

/// Whether a plan's folder has maps of the ground, and this config's temperatures need them.
[[nodiscard]] bool uses_ground_maps(const Path& folder, const DatasetSpec& spec);

/// Those maps; null without any, or if this config's temperatures need none. Errors as read_baked_scene() and
/// read_ground_maps().
[[nodiscard]] std::shared_ptr<const GroundMaps> read_needed_ground_maps(const Path& folder,
                                                                        const DatasetSpec& spec,
                                                                        const Assets& assets);

/// What the clips of the plan in a folder show, with all that a lens or overscan adds. Errors as read_baked_track().
[[nodiscard]] std::vector<GroundView> ground_views(const Path& folder, const DatasetPlan& plan,
                                                   const BakedScene& scene, const Assets& assets);

/// Makes the maps of the scene in a plan's folder, on all cores, and writes them there: light where its clips may see the
/// ground or, where cameras may fly anywhere (render.posed_actors "all"), everywhere. `scratch` is a folder on the same
/// disk. Errors as read_baked_scene(), read_baked_track() and write_ground_maps().
void add_ground_maps(const Path& folder, const Path& scratch, const DatasetSpec& spec,
                     const DatasetPlan& plan, const Assets& assets,
                     const std::function<void(const Progress&)>& show);

/// A plan and all of its config: what any machine needs to make any part of a dataset.
struct PlannedDataset {
  ResolvedConfig config;  ///< with its flights cut into clips
  DatasetPlan plan;
};

/// plan_into(), and the resolved config as config.json in the same folder.
PlannedDataset plan_with_config(const Path& folder, const ResolvedConfig& config, const std::string& name,
                                const PlanOptions& options);

/// Reads what plan_with_config() wrote. Plans nothing, and does not look at the files that the plan was made from: they
/// need not exist on this machine. ConfigError with what is missing if `folder` is no such plan; DataError if plan.json or
/// config.json is damaged, of another plan, or of another version.
[[nodiscard]] PlannedDataset open_plan(const Path& folder, const Assets& assets);

/// Plans a dataset into OUT/plan, or uses the plan that is there (plan_into). One of several runs that share the folder
/// does so; the others wait for it. ConfigError if `out` holds a dataset of another config; then nothing changes.
[[nodiscard]] DatasetPlan plan_to_generate(const Path& out, const ResolvedConfig& config,
                                           const std::string& name, const PlanOptions& options);

/// The same for passes alone: ConfigError if `out` holds passes of another config.
[[nodiscard]] DatasetPlan plan_to_render(const Path& out, const ResolvedConfig& config,
                                         const std::string& name, const PlanOptions& options);

/// The same for a preview, into OUT/preview/plan, beside a dataset of any config.
DatasetPlan plan_to_preview(const Path& out, const ResolvedConfig& config, const std::string& name,
                            PlanOptions options);

}  // namespace thermal
