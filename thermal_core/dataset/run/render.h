#pragma once

#include <string>

#include "dataset/progress.h"
#include "dataset/run/options.h"
#include "io/config/config.h"

namespace thermal {

/// The Blender to use: `named`, or "blender" on PATH where that is empty. ConfigError if the named one is no program,
/// IoError if there is none; `option` is what names one, such as "--blender".
[[nodiscard]] Path find_blender(const std::string& named, const std::string& option);

/// Renders passes and manifests only, into `passes/<clip>`; otherwise like generate(). `config` has the clips of the
/// plan in options.plan.
RunOutcome render(const ResolvedConfig& config, const GenerateOptions& options, const RunHooks& hooks);

/// Renders a map of the config's place, and colour stills of it, into preview/; overwrites earlier ones. Returns the
/// number of pictures. plan_in_dataset() has written the plan.
int preview(const ResolvedConfig& config, const GenerateOptions& options, const RunHooks& hooks);

}  // namespace thermal
