#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "dataset/plan/planner.h"
#include "io/assets.h"
#include "io/config/config.h"

namespace veldt {

/// Prints which engine was chosen, and why; nothing if the config names one.
void print_engine(const thermal::DatasetSpec& spec);

/// Prints what a run would make: a line per clip, or per flight that clips are cut from; then totals, and an estimate
/// of run time and disk space.
void print_plan(const thermal::DatasetSpec& spec, const thermal::DatasetPlan& plan,
                const std::vector<thermal::ClipSpec>& chosen);

/// Calls `plan` with options for --threads cores. Shows progress after ten seconds.
void plan_with_progress(const CommonOptions& common, const thermal::Assets& assets,
                        const std::function<void(const thermal::PlanOptions& options)>& plan);

/// plan_dataset(), which writes nothing.
[[nodiscard]] thermal::PlannedDataset plan_with_progress(const CommonOptions& common,
                                                         const thermal::Assets& assets,
                                                         const thermal::ResolvedConfig& config,
                                                         const std::string& name);

}  // namespace veldt
