#pragma once

#include <string>

#include "dataset/plan/planning.h"
#include "io/config/config.h"

namespace thermal {

/// Plans a dataset into OUT/plan, or uses the plan that is there (plan_into). One of several runs that share the folder
/// does so; the others wait for it. ConfigError if `out` holds a dataset of another config; then nothing changes.
[[nodiscard]] DatasetPlan plan_to_generate(const Path& out, const Config& config, const std::string& name,
                                           const PlanOptions& options);

/// The same for passes alone: ConfigError if `out` holds passes of another config.
[[nodiscard]] DatasetPlan plan_to_render(const Path& out, const Config& config, const std::string& name,
                                         const PlanOptions& options);

/// The same for a preview, into OUT/preview/plan, beside a dataset of any config.
DatasetPlan plan_to_preview(const Path& out, const Config& config, const std::string& name,
                            PlanOptions options);

}  // namespace thermal
