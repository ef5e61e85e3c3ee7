#pragma once

#include "dataset/plan/planning.h"

namespace thermal {

/// A plan and all of its config: what any machine needs to make any part of a dataset.
struct PlannedDataset {
  Config config;  ///< with its flights cut into clips
  DatasetPlan plan;
};

/// plan_into(), and the resolved config as config.json in the same folder.
PlannedDataset plan_with_config(const Path& folder, const Config& config, const std::string& name,
                                const PlanOptions& options);

/// Reads what plan_with_config() wrote. Plans nothing, and does not look at the files that the plan was made from: they
/// need not exist on this machine. ConfigError with what is missing if `folder` is no such plan; DataError if plan.json or
/// config.json is damaged, of another plan, or of another version.
[[nodiscard]] PlannedDataset open_plan(const Path& folder, const Assets& assets);

}  // namespace thermal
