#pragma once

#include <functional>
#include <string>

#include "cli/command.h"
#include "dataset/plan/planning.h"
#include "io/assets.h"

namespace veldt {

/// Calls `plan` with options for --threads cores. Shows progress after ten seconds.
void plan_with_progress(const CommonOptions& common, const thermal::Assets& assets,
                        const std::function<void(const thermal::PlanOptions& options)>& plan);

/// plan_dataset(), which writes nothing.
[[nodiscard]] thermal::DatasetPlan plan_with_progress(const CommonOptions& common,
                                                      const thermal::Assets& assets,
                                                      const thermal::Config& config, const std::string& name);

}  // namespace veldt
