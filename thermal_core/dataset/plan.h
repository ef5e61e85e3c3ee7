#pragma once

#include <string>
#include <vector>

#include "io/files.h"
#include "io/json_file.h"

namespace thermal {

/// What a clip will be, known before anything is rendered.
struct ClipPlan {
  std::string id;
  std::string flight;  ///< the flight it is cut from; empty if it is none's
  int frames = 0;
  int frames_with_actors = 0;
  double min_agl_m = 0;
  double max_agl_m = 0;
};

struct DatasetPlan {
  std::vector<ClipPlan> clips;  ///< the config's own, then those its flights are cut into
  Json cut_clips;               ///< the latter, as a config has them
};

/// Plans a dataset by running blender_scripts/plan_dataset.py, which needs no Blender: checks what a config
/// means (paths, species, targets, the camera above ground), cuts its flights and foresees its clips.
/// ConfigError, starting with `name`, for a config that can't be meant; IoError if Python or NumPy is missing.
[[nodiscard]] DatasetPlan plan_dataset(const Json& resolved_config, const std::string& name,
                                       const Path& home);

/// The Python that runs the planning: $VELDT_PYTHON, /usr/bin/python3, or python3 on $PATH; empty if none is.
[[nodiscard]] Path find_python();

}  // namespace thermal
