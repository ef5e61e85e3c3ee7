#pragma once

#include "dataset/plan/dataset_plan.h"
#include "dataset/progress.h"
#include "dataset/run/options.h"
#include "io/config/config.h"

namespace thermal {

/// Makes a dataset: Blender renders, and frames are converted while later ones render. Resumes an unfinished dataset;
/// leaves a finished one alone. `config` has the clips of the plan (with_flights_cut) in options.plan. Other runs may
/// make other clips of it at the same time. A clip over which Blender crashes twice, or whose passes cannot be converted,
/// is listed in the outcome, and the others are still made; the next run tries it again.
/// ConfigError, IoError, TryAgainError or Cancelled; finished clips stay.
RunOutcome generate(const ResolvedConfig& config, const DatasetPlan& plan, const GenerateOptions& options,
                    const RunHooks& hooks);

}  // namespace thermal
