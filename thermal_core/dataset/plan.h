#pragma once

#include <string>
#include <vector>

#include "io/files.h"
#include "io/json_file.h"

namespace thermal {

/// What a clip will be, known before anything is rendered.
struct ClipPlan {
  std::string id;
  int frames = 0;
  int frames_with_actors = 0;
  double min_agl_m = 0;
  double max_agl_m = 0;
};

/// Plans a dataset by running blender_scripts/plan_dataset.py, which needs no Blender: checks what a config
/// means (paths, species, targets, the camera above ground) and foresees its clips.
/// ConfigError, starting with `name`, for a config that can't be meant; IoError if Python or NumPy is missing.
[[nodiscard]] std::vector<ClipPlan> plan_dataset(const Json& resolved_config, const std::string& name,
                                                 const Path& home);

/// The Python that runs the planning: $VELDT_PYTHON, /usr/bin/python3, or python3 on $PATH; empty if none is.
[[nodiscard]] Path find_python();

}  // namespace thermal
