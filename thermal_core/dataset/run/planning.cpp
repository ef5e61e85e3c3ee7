#include "dataset/run/planning.h"

#include <functional>

#include "base/error.h"
#include "dataset/dataset_index.h"
#include "dataset/run/passes_folder.h"
#include "io/system/files.h"
#include "io/system/folder_lock.h"

namespace thermal {
namespace {

/// Calls `plan` while no other run changes the folder. A folder that a failure leaves with nothing in it is removed.
DatasetPlan in_turn(const Path& out, const std::function<DatasetPlan()>& plan) {
  const bool was_there = std::filesystem::exists(out);
  try {
    const FolderLock lock(out, {});
    DatasetPlan planned;
    lock.in_turn([&] { planned = plan(); });
    return planned;
  } catch (...) {
    if (!was_there) (void)sweep_folder(out);
    throw;
  }
}

/// `check` compares the folder's own config with the planned one.
DatasetPlan plan_for(const Path& out, const Config& config, const std::string& name,
                     const PlanOptions& options, void (*check)(const Layout& layout, const Config& config)) {
  const Layout layout{out};
  return in_turn(out, [&] {
    const std::string made = (unfinished_plan(layout.plan()) / "plan.json").string();
    return plan_into(layout.plan(), config, name, options,
                     [&](const DatasetPlan& plan) { check(layout, with_flights_cut(config, plan, made)); });
  });
}

}  // namespace

DatasetPlan plan_to_generate(const Path& out, const Config& config, const std::string& name,
                             const PlanOptions& options) {
  return plan_for(out, config, name, options, check_same_dataset);
}

DatasetPlan plan_to_render(const Path& out, const Config& config, const std::string& name,
                           const PlanOptions& options) {
  return plan_for(out, config, name, options, check_same_passes);
}

DatasetPlan plan_to_preview(const Path& out, const Config& config, const std::string& name,
                            PlanOptions options) {
  options.preview = true;
  const Path folder = Layout{out}.preview();
  return in_turn(out, [&] {
    make_own_folder(folder);
    return plan_into(folder / "plan", config, name, options);
  });
}

}  // namespace thermal
