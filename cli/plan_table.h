#pragma once

#include <vector>

#include "dataset/plan/plan.h"
#include "io/config/config.h"

namespace veldt {

/// Prints which engine was chosen, and why; nothing if the config names one.
void print_engine(const thermal::Config& config);

/// Prints what a run would make: a line per clip, or per flight that clips are cut from; then totals, and an estimate
/// of run time and disk space.
void print_plan(const thermal::Config& config, const thermal::DatasetPlan& plan,
                const std::vector<thermal::ClipConfig>& chosen);

}  // namespace veldt
