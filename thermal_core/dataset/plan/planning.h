#pragma once

#include <functional>
#include <string>

#include "dataset/plan/plan.h"
#include "dataset/run/progress.h"
#include "io/assets.h"

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
[[nodiscard]] DatasetPlan plan_dataset(const Config& config, const std::string& name,
                                       const PlanOptions& options);

/// The same with the baked scene, the tracks of all clips and, if the config needs them, maps of the ground, in `folder`.
/// A plan that is already there is used again if nothing that it depends on has changed and none of its files is
/// damaged; maps that it lacks are added. Otherwise `may_replace` is called with the new one, which is still in
/// unfinished_plan(), and it takes the old one's place in one step unless that throws. Of two runs at once, one plans,
/// and the other waits for it.
[[nodiscard]] DatasetPlan plan_into(const Path& folder, const Config& config, const std::string& name,
                                    const PlanOptions& options,
                                    const std::function<void(const DatasetPlan&)>& may_replace = {});

/// Where the plan of this folder is made.
[[nodiscard]] Path unfinished_plan(const Path& folder);

/// The Python that runs the planning: $VELDT_PYTHON, /usr/bin/python3, or python3 on $PATH; empty if there is none.
[[nodiscard]] Path find_python();

}  // namespace thermal
