#pragma once

#include <vector>

#include "dataset/plan.h"
#include "io/config.h"

namespace veldt {

/// Prints what a dry run foresees: a line a clip, or a flight where clips are cut from one; then the sums, and about
/// how long making them takes and how much disk.
void print_plan(const thermal::Config& config, const thermal::DatasetPlan& plan,
                const std::vector<thermal::ClipConfig>& chosen);

}  // namespace veldt
