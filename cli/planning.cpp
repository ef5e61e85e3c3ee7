#include "cli/planning.h"

#include <chrono>

#include "cli/progress_bar.h"

namespace veldt {

thermal::DatasetPlan plan_with_progress(const thermal::Json& resolved_config, const std::string& name,
                                        const thermal::Path& home, const CommonOptions& common) {
  constexpr std::chrono::seconds kPatience(10);
  ProgressBar bar(common, "planning", "flights", kPatience);
  return thermal::plan_dataset(resolved_config, name,
                               {.home = home, .threads = common.threads, .show = hooks_for(bar).progress});
}

}  // namespace veldt
