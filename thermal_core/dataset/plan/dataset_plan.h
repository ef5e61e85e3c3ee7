#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/assets.h"
#include "io/config/config.h"
#include "io/json/file.h"

namespace thermal {

/// Properties of a clip that are known before rendering.
struct ClipPlan {
  std::string id;
  std::string of_flight;  ///< the flight it is cut from; empty if there is none
  double start_s = 0;
  int frames = 0;
  double frame_rate_hz = 0;
  int frames_with_actors = 0;
  double min_agl_m = 0;
  double max_agl_m = 0;
  double mean_agl_m = 0;
  double mean_look_angle_deg = 0;
};

/// What a config means, worked out once by blender_scripts/plan_scene.py.
struct DatasetPlan {
  std::vector<ClipPlan> clips;  ///< the config's own, then those cut from its flights
  std::map<std::string, double>
      cover_shares;  ///< of materials seen from above, without actors; their sum is 1
  std::vector<std::string> actor_materials;
  Json config = {};                          ///< what it was made from: planned_part() of a config
  std::map<std::string, std::string> files;  ///< SHA-256 of the other files it was made from, by path
};

/// A plan and all of its config: what any machine needs to make any part of a dataset.
struct PlannedDataset {
  ResolvedConfig config;  ///< with its flights cut into clips
  DatasetPlan plan;
};

/// Version of the format of plans.
inline constexpr int kPlanVersion = 1;

/// The part of a config that its plan depends on; with another sensor, weather or season, a plan is the same.
[[nodiscard]] Json planned_part(const ResolvedConfig& config);

/// Reads a plan. DataError with `name` if it is damaged or of another version.
[[nodiscard]] DatasetPlan plan_of(const Json& document, const std::string& name, const Assets& assets);

/// The same config with its flights cut into the clips of its plan, which follow its own. DataError with `name`, the
/// plan's, unless the plan has the config's own clips, then clips of its flights, each id once, and no more frames than
/// an int counts.
[[nodiscard]] ResolvedConfig with_flights_cut(ResolvedConfig config, const DatasetPlan& plan,
                                              const std::string& name);

}  // namespace thermal
