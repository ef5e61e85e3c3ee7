#include "dataset/plan.h"

#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "io/child_process.h"
#include "io/resources.h"

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

Output run_planning(const Json& resolved_config, const Path& python, const Path& script,
                    const PlanOptions& options) {
  return run_program({python.string(), "-I", "-B", script.string(), "--config", "-", "--json", "--processes",
                      std::to_string(thread_count(options.threads)), "--events-fd",
                      std::to_string(ChildProcess::kEventDescriptor)},
                     to_text(resolved_config),
                     [&options](const std::string& line) { show_event(line, options); });
}

}  // namespace

Path find_python() {
  if (const char* named = std::getenv("VELDT_PYTHON"); named != nullptr && *named != '\0')
    return find_program(named);
  const Path system = find_program("/usr/bin/python3");
  return system.empty() ? find_program("python3") : system;
}

DatasetPlan plan_dataset(const Json& resolved_config, const std::string& name, const PlanOptions& options) {
  const Path python = find_python();
  if (python.empty()) throw IoError("no python3 on PATH; install it (apt-get install python3-numpy)");
  const Path script = options.home / "blender_scripts" / "plan_dataset.py";
  const Output output = run_planning(resolved_config, python, script, options);
  constexpr int kConfigFault = 2;
  if (output.status.signal == 0 && output.status.code == kConfigFault) throw_faults(output.error, name);
  if (output.status.signal != 0 || output.status.code != 0) {
    const std::string why = printable(output.last_words());
    throw IoError(fmt::format("{} {} {}{}", python.string(), script.filename().string(),
                              output.status.in_words(), why.empty() ? "" : ": " + why));
  }
  const Json answer = parse_json(output.out, script.string());
  DatasetPlan plan{.clips = {}, .cut_clips = answer.at("cut_clips")};
  for (const Json& clip : answer.at("clips")) {
    plan.clips.push_back({.id = clip.at("id"),
                          .flight = clip.at("flight"),
                          .frames = clip.at("frames"),
                          .frames_with_actors = clip.at("frames_with_actors"),
                          .min_agl_m = clip.at("min_agl_m"),
                          .max_agl_m = clip.at("max_agl_m")});
  }
  return plan;
}

}  // namespace thermal
