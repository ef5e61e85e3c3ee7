#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dataset/plan/dataset_plan.h"
#include "dataset/progress.h"
#include "io/assets.h"
#include "io/config/config.h"
#include "io/system/files.h"

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

/// Runs blender_scripts/plan_scene.py, with further arguments, which does not need Blender: checks the meaning of a config
/// (paths, species, targets, the camera above ground), cuts its flights and plans its clips. ConfigError, starting with
/// `name`, for an invalid config; IoError if Python or NumPy is missing.
[[nodiscard]] DatasetPlan run_planner(const ResolvedConfig& config, const std::string& name,
                                      const PlanOptions& options,
                                      const std::vector<std::string>& arguments = {});

/// Plans a dataset, and writes nothing.
[[nodiscard]] PlannedDataset plan_dataset(const ResolvedConfig& config, const std::string& name,
                                          const PlanOptions& options);

/// The Python that runs the planning: $VELDT_PYTHON, /usr/bin/python3, or python3 on $PATH; empty if there is none.
[[nodiscard]] Path find_python();

}  // namespace thermal
