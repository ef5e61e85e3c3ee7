#include "dataset/plan/planning.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "dataset/plan/ground_planning.h"
#include "dataset/plan/plan_checksums.h"
#include "io/assets.h"
#include "io/config/asset_files.h"
#include "io/system/child_process.h"
#include "io/system/files.h"
#include "io/system/locked_folder.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

[[noreturn]] void throw_faults(const std::string& text, const std::string& name) {
  std::string message;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    message += (message.empty() ? "" : "\n") + name + ": " + line;
  }
  throw ConfigError(message);
}

/// Passes on an event of the script; a line that is none would be its fault, not the user's.
void show_event(const std::string& line, const PlanOptions& options) {
  const Json event = Json::parse(line, nullptr, false);
  if (options.show && event.is_object() && event.value("event", "") == "planned")
    options.show(
        {.clip = event.value("id", ""), .done = event.value("done", 0), .total = event.value("total", 0)});
}

/// For a planner that failed, but not because of the config.
[[noreturn]] void throw_failure(const std::string& planner, const Output& output) {
  constexpr int kTryAgain = 75;  // the disk is full, or a process of the planner was killed
  std::string message = fmt::format("{} {}", planner, output.status.in_words());
  if (output.status.signal == SIGKILL) {
    message += fmt::format("; {}", kKilledHint);
  } else if (const std::string why = printable(output.last_error_line()); !why.empty()) {
    message += ": " + why;
  }
  if (output.status.is_killed() || output.status.code == kTryAgain) throw TryAgainError(message);
  throw IoError(message);
}

/// Runs the script with additional arguments, and returns what it prints.
std::string run_planning(const Config& config, const std::string& name, const PlanOptions& options,
                         const std::vector<std::string>& arguments) {
  const Path python = find_python();
  if (python.empty()) throw IoError("no python3 on PATH; install it (apt-get install python3-numpy)");
  try {
    check_asset_files(planned_part(config).at("scene"), options.assets);
  } catch (const ConfigError& fault) {
    throw_faults(fault.what(), name);
  }
  const Path script = options.assets.script("plan_scene.py");
  std::vector<std::string> command = {python.string(),
                                      "-I",
                                      script.string(),
                                      "--config",
                                      "-",
                                      "--processes",
                                      std::to_string(thread_count(options.threads)),
                                      "--events-fd",
                                      std::to_string(ChildProcess::kEventDescriptor)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Output output = run_program(command, to_text(planned_part(config)),
                                    [&options](const std::string& line) { show_event(line, options); });
  constexpr int kConfigFault = 2;
  if (output.status.signal == 0 && output.status.code == kConfigFault) throw_faults(output.error, name);
  if (output.status.signal != 0 || output.status.code != 0)
    throw_failure(fmt::format("{} {}", python.string(), script.filename().string()), output);
  return output.out;
}

/// The plan in a folder, if there is a complete one of this version.
std::optional<DatasetPlan> plan_in(const Path& folder, const Assets& assets) {
  const Path file = folder / "plan.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    return plan_of(read_json(file), file.string(), assets);
  } catch (const Error&) {  // of another version, or damaged: it is made again
    return std::nullopt;
  }
}

bool is_unchanged(const std::string& file, const std::string& sha256, const Assets& assets) {
  try {
    return sha256_of_file(assets.home() / file) == sha256;  // an absolute path replaces home()
  } catch (const IoError&) {
    return false;
  }
}

bool is_made_from(const DatasetPlan& plan, const Config& config, const Assets& assets) {
  return plan.config == planned_part(config) && std::ranges::all_of(plan.files, [&assets](const auto& file) {
           return is_unchanged(file.first, file.second, assets);
         });
}

/// The plan in a folder, unless it is of another config, was made from other files, or is damaged. Its own files, which
/// may be large, are read last.
std::optional<DatasetPlan> current_plan(const Path& folder, const Config& config,
                                        const PlanOptions& options) {
  std::optional<DatasetPlan> plan = plan_in(folder, options.assets);
  const bool has_pictures = !options.preview || std::filesystem::exists(folder / "preview");
  if (plan && has_pictures && is_made_from(*plan, config, options.assets) && has_its_checksums(folder))
    return plan;
  return std::nullopt;
}

std::vector<std::string> baking_arguments(const Path& part, const Path& earlier, const PlanOptions& options) {
  std::vector<std::string> arguments = {"--out", part.string()};
  if (has_its_checksums(earlier)) arguments.insert(arguments.end(), {"--earlier", earlier.string()});
  if (!options.blender.empty()) arguments.insert(arguments.end(), {"--blender", options.blender.string()});
  if (options.preview) arguments.emplace_back("--preview");
  return arguments;
}

/// Previews need no maps.
bool has_its_maps(const Path& folder, const Config& config, const PlanOptions& options) {
  return options.preview || has_needed_ground_maps(folder, config, options.assets);
}

/// Adds the maps that a plan's folder lacks, through `part`, and their checksums. A plan that is killed in between does
/// not agree with its checksums, and is made again.
void complete_maps(const Path& folder, const Path& part, const Config& config, const DatasetPlan& plan,
                   const PlanOptions& options) {
  if (has_its_maps(folder, config, options)) return;
  with_threads(options.threads,
               [&] { add_ground_maps(folder, part, config, plan, options.assets, options.show_maps); });
  write_checksums(folder);
}

}  // namespace

Path find_python() {
  if (const char* named = std::getenv("VELDT_PYTHON"); named != nullptr && *named != '\0')
    return find_program(named);
  const Path system = find_program("/usr/bin/python3");
  return system.empty() ? find_program("python3") : system;
}

DatasetPlan plan_dataset(const Config& config, const std::string& name, const PlanOptions& options) {
  constexpr const char* kScript = "plan_scene.py";
  return plan_of(parse_json(run_planning(config, name, options, {}), kScript), kScript, options.assets);
}

Path unfinished_plan(const Path& folder) {
  Path part = folder;
  return part += ".part";
}

namespace {

DatasetPlan plan_again(const Path& folder, const Config& config, const std::string& name,
                       const PlanOptions& options,
                       const std::function<void(const DatasetPlan&)>& may_replace) {
  const Path part = unfinished_plan(folder);
  const LockedFolder locked(part);
  if (auto plan = current_plan(folder, config, options)) {  // another run has made it, or it lacks maps
    complete_maps(folder, part, config, *plan, options);
    return *std::move(plan);
  }
  (void)run_planning(config, name, options, baking_arguments(part, folder, options));
  DatasetPlan plan = plan_of(read_json(part / "plan.json"), (part / "plan.json").string(), options.assets);
  if (may_replace) may_replace(plan);
  complete_maps(part, part, config, plan, options);
  write_checksums(part);
  replace_folder(part, folder);
  return plan;
}

}  // namespace

DatasetPlan plan_into(const Path& folder, const Config& config, const std::string& name,
                      const PlanOptions& options,
                      const std::function<void(const DatasetPlan&)>& may_replace) {
  std::optional<DatasetPlan> plan = current_plan(folder, config, options);
  if (!plan || !has_its_maps(folder, config, options))
    plan = plan_again(folder, config, name, options, may_replace);
  const std::optional<LeftOver> left_over = sweep_unless_locked(unfinished_plan(folder));
  if (left_over && options.left_over) options.left_over(*left_over);
  return *std::move(plan);
}

}  // namespace thermal
