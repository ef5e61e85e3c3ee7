#include "base/error.h"
#include "dataset/dataset_index.h"
#include "dataset/generate.h"
#include "dataset/passes_room.h"
#include "io/output_folder.h"

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
    if (!was_there) sweep_folder(out);
    throw;
  }
}

}  // namespace

DatasetPlan plan_to_generate(const Path& out, const Config& config, const std::string& name,
                             const PlanOptions& options) {
  const Layout layout{out};
  return in_turn(out, [&] {
    return plan_into(layout.plan(), config, name, options, [&](const DatasetPlan& plan) {
      check_same_dataset(layout, with_flights_cut(config, plan));
    });
  });
}

DatasetPlan plan_to_render(const Path& out, const Config& config, const std::string& name,
                           const PlanOptions& options) {
  const Layout layout{out};
  return in_turn(out, [&] {
    return plan_into(layout.plan(), config, name, options, [&](const DatasetPlan& plan) {
      check_same_passes(layout, with_flights_cut(config, plan));
    });
  });
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
