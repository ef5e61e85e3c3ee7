#include "cli/planning.h"

#include <chrono>
#include <vector>

#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "io/assets.h"
#include "io/system/child_process.h"

namespace veldt {

void plan_with_progress(const CommonOptions& common, const thermal::Assets& assets,
                        const std::function<void(const thermal::PlanOptions& options)>& plan) {
  constexpr std::chrono::seconds kPatience(10);
  std::vector<thermal::LeftOver> left_over;
  {
    ProgressBar bar(common, "planning", "flights", kPatience);
    ProgressBar maps(common, "building the scene", "cells", kPatience);
    plan({.assets = assets,
          .threads = common.threads,
          .blender = thermal::find_program("blender"),
          .show = hooks_for(bar).progress,
          .show_maps = hooks_for(maps).progress,
          .left_over = [&left_over](const thermal::LeftOver& one) { left_over.push_back(one); }});
  }
  print_left_over(left_over);
}

thermal::DatasetPlan plan_with_progress(const CommonOptions& common, const thermal::Assets& assets,
                                        const thermal::Config& config, const std::string& name) {
  thermal::DatasetPlan plan;
  plan_with_progress(common, assets, [&](const thermal::PlanOptions& options) {
    plan = thermal::plan_dataset(config, name, options);
  });
  return plan;
}

}  // namespace veldt
