#include "dataset/plan/plan_folder.h"

#include "base/error.h"
#include "dataset/plan/plan_checksums.h"
#include "io/json/file.h"

namespace thermal {
namespace {

Path config_in(const Path& folder) { return folder / "config.json"; }

void check_is_there(const Path& folder) {
  for (const Path& file : {folder / "plan.json", config_in(folder)})
    if (!std::filesystem::exists(file))
      throw ConfigError(fault("--plan", folder.string(), "",
                              "a folder that veldt plan wrote, with " + file.filename().string()));
}

bool has_text(const Path& file, const std::string& text) {
  return std::filesystem::exists(file) && read_file(file) == text;
}

/// A config of veldt plan's own: what is wrong with it is a fault of the file.
Config read_resolved(const Path& file, const Assets& assets) {
  try {
    return resolve_config(read_json(file), file.string(), assets);
  } catch (const ConfigError& fault) {
    throw DataError(fault.what());
  }
}

}  // namespace

PlannedDataset plan_with_config(const Path& folder, const Config& config, const std::string& name,
                                const PlanOptions& options) {
  const std::string text = to_text(config.resolved);
  DatasetPlan plan = plan_into(folder, config, name, options, [&](const DatasetPlan&) {
    write_file_atomically(config_in(unfinished_plan(folder)), text);
  });
  if (!has_text(config_in(folder), text)) {  // what is not planned may have changed
    write_file_atomically(config_in(folder), text);
    write_checksums(folder);
  }
  Config cut = with_flights_cut(config, plan, (folder / "plan.json").string());
  return {.config = std::move(cut), .plan = std::move(plan)};
}

PlannedDataset open_plan(const Path& folder, const Assets& assets) {
  check_is_there(folder);
  check_files(folder, {"plan.json", config_in(folder).filename().string()});
  const Path file = folder / "plan.json";
  DatasetPlan plan = plan_of(read_json(file), file.string(), assets);
  const Config config = read_resolved(config_in(folder), assets);
  Config cut = with_flights_cut(config, plan, file.string());
  return {.config = std::move(cut), .plan = std::move(plan)};
}

}  // namespace thermal
