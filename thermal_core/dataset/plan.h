#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dataset/progress.h"
#include "io/files.h"
#include "io/json_file.h"

namespace thermal {

/// Properties of a clip that are known before rendering.
struct ClipPlan {
  std::string id;
  std::string flight;  ///< the flight it is cut from; empty if there is none
  int frames = 0;
  int frames_with_actors = 0;
  double min_agl_m = 0;
  double max_agl_m = 0;
};

struct DatasetPlan {
  std::vector<ClipPlan> clips;  ///< the config's own, then those cut from its flights
  Json cut_clips;               ///< the latter, in the form of a config
};

/// How a plan is made.
struct PlanOptions {
  Path home;
  /// Flights planned at once, each in a process; 0: one per core. The plan does not depend on it.
  int threads = 0;
  /// Called for each planned clip or flight; `clip` is its id.
  std::function<void(const Progress&)> show = {};
};

/// Plans a dataset by running blender_scripts/plan_dataset.py, which does not need Blender: checks the meaning of a
/// config (paths, species, targets, the camera above ground), cuts its flights and plans its clips. ConfigError,
/// starting with `name`, for an invalid config; IoError if Python or NumPy is missing.
[[nodiscard]] DatasetPlan plan_dataset(const Json& resolved_config, const std::string& name,
                                       const PlanOptions& options);

/// The Python that runs the planning: $VELDT_PYTHON, /usr/bin/python3, or python3 on $PATH; empty if there is none.
[[nodiscard]] Path find_python();

}  // namespace thermal
