#pragma once

#include <string>

#include "dataset/plan/planning.h"
#include "dataset/progress.h"
#include "dataset/run_options.h"
#include "io/config.h"

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

/// Makes a dataset: Blender renders, and frames are converted while later ones render. Resumes an unfinished dataset;
/// leaves a finished one alone. `config` has the clips of the plan (with_flights_cut), which plan_to_generate() has
/// written. Other runs may make other clips of it at the same time. A clip over which Blender crashes twice, or whose passes cannot be converted, is listed in
/// the outcome, and the others are still made; the next run tries it again.
/// ConfigError, IoError, TryAgainError or Cancelled; finished clips stay.
RunOutcome generate(const Config& config, const DatasetPlan& plan, const GenerateOptions& options,
                    const RunHooks& hooks);

/// Renders passes and manifests only, into passes/<clip>; otherwise like generate().
RunOutcome render(const Config& config, const GenerateOptions& options, const RunHooks& hooks);

/// Renders a map of the config's place, and colour stills of it, into preview/; overwrites earlier ones. Returns the
/// number of pictures.
int preview(const Config& config, const GenerateOptions& options, const RunHooks& hooks);

}  // namespace thermal
