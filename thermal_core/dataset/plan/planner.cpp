#include "dataset/plan/planner.h"

#include <csignal>
#include <cstdlib>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "io/config/asset_files.h"
#include "io/json/file.h"
#include "io/system/child_process.h"

namespace thermal {
namespace {

/// A fault that the planner found, which counts clips and flights one by one: "clips[7].flight …" of entry `clips[2]`.
std::string with_entry_named(const std::string& line, const EntryNames& entries) {
  const std::string_view text = line;
  const std::size_t begin = text.find('[');
  const std::size_t end = text.find(']');
  const auto list = entries.find(line.substr(0, begin));
  if (list == entries.end() || end == std::string_view::npos) return line;
  const auto number = number_in<std::size_t>(text.substr(begin + 1, end - begin - 1));
  return number && *number < list->second.size() ? list->second[*number] + line.substr(end + 1) : line;
}

/// Of each line that the planner printed.
std::vector<std::string> faults_in(const std::string& text, const EntryNames& entries) {
  std::vector<std::string> faults;
  for (const std::string_view line : split(text, '\n'))
    if (!line.empty()) faults.push_back(with_entry_named(std::string(line), entries));
  return faults;
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

}  // namespace

DatasetPlan run_planner(const ResolvedConfig& config, const std::string& name, const PlanOptions& options,
                        const std::vector<std::string>& arguments) {
  const Path python = find_python();
  if (python.empty()) throw IoError("no python3 on PATH; install it (apt-get install python3-numpy)");
  const Json planned = planned_part(config);
  try {
    check_asset_files(planned.at("scene"), options.assets);
  } catch (const ConfigError& fault) {
    throw_faults({fault.what()}, name);
  }
  constexpr const char* kScript = "plan_scene.py";
  std::vector<std::string> command = {python.string(),
                                      "-I",
                                      options.assets.script(kScript).string(),
                                      "--config",
                                      "-",
                                      "--processes",
                                      std::to_string(thread_count(options.threads)),
                                      "--events-fd",
                                      std::to_string(ChildProcess::kEventDescriptor)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Output output = run_program(command, to_text(planned),
                                    [&options](const std::string& line) { show_event(line, options); });
  constexpr int kConfigFault = 2;
  if (output.status.signal == 0 && output.status.code == kConfigFault)
    throw_faults(faults_in(output.error, config.entries), name);
  if (output.status.signal != 0 || output.status.code != 0)
    throw_failure(fmt::format("{} {}", python.string(), kScript), output);
  return plan_of(parse_json(output.out, kScript), kScript, options.assets);
}

PlannedDataset plan_dataset(const ResolvedConfig& config, const std::string& name,
                            const PlanOptions& options) {
  DatasetPlan plan = run_planner(config, name, options);
  ResolvedConfig cut = with_flights_cut(config, plan, name);
  return {.config = std::move(cut), .plan = std::move(plan)};
}

Path find_python() {
  if (const char* named = std::getenv("VELDT_PYTHON"); named != nullptr && *named != '\0')
    return find_program(named);
  const Path system = find_program("/usr/bin/python3");
  return system.empty() ? find_program("python3") : system;
}

}  // namespace thermal
