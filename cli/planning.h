#pragma once

#include <string>

#include "cli/command.h"
#include "dataset/plan.h"

namespace veldt {

/// plan_dataset() on --threads cores. A plan that takes longer than ten seconds shows how far it is.
[[nodiscard]] thermal::DatasetPlan plan_with_progress(const thermal::Json& resolved_config,
                                                      const std::string& name, const thermal::Path& home,
                                                      const CommonOptions& common);

}  // namespace veldt
