#include <algorithm>
#include <memory>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/version.h"
#include "cli/command.h"
#include "cli/output.h"
#include "dataset/plan/planner.h"
#include "io/assets.h"
#include "io/system/child_process.h"
#include "io/system/machine.h"
#include "raycast/engine_version.h"

namespace veldt {
namespace {

/// A requirement, and whether it is installed.
struct Finding {
  std::string what;
  std::string found;            ///< version and path; empty if missing
  std::string remedy;           ///< how to get it
  std::string needed_for = {};  ///< of an engine, of which one is enough; empty: for everything
};

/// First line that a program prints; empty if it cannot be run.
std::string first_line(const std::vector<std::string>& argv) {
  if (argv.front().empty()) return "";
  const thermal::Output output = thermal::run_program(argv);
  if (output.status.signal != 0 || output.status.code != 0) return "";
  return output.out.substr(0, output.out.find('\n'));
}

Finding find_home() {
  try {
    return {"assets and scripts", thermal::Assets::find().home().string(), ""};
  } catch (const thermal::IoError& error) {
    return {"assets and scripts", "", error.what()};
  }
}

Finding find_blender_engine() {
  const std::string blender = thermal::find_program("blender").string();
  const std::string version = first_line({blender, "--version"});
  return {"Blender", version.empty() ? "" : version + ", " + blender,
          "apt-get install blender, or name one with --blender PATH",
          "the engine blender, 3D models of your own, render --preview and bench --suite render"};
}

Finding find_embree() {
  constexpr const char* kNeededFor = "the engine embree";
  try {
    return {"Embree", thermal::engine_version(), "", kNeededFor};
  } catch (const thermal::Error& error) {
    return {"Embree", "", error.what(), kNeededFor};
  }
}

/// How many cores commands use without --threads, and the reason for the limit.
std::string describe(const thermal::Cores& cores) {
  std::string text = fmt::format("{} usable of {}", cores.usable(), cores.machine);
  if (cores.usable() < cores.affinity)
    return fmt::format("{}: a control group limits CPU time to {:.2f} cores", text, *cores.limit);
  if (cores.affinity < cores.machine) return fmt::format("{}: CPU affinity allows {}", text, cores.affinity);
  return text;
}

std::vector<Finding> find_all() {
  std::vector<Finding> findings = {{"veldt", std::string(thermal::kVersion), ""}, find_home()};
  findings.push_back({"cores", describe(thermal::find_cores()), ""});
  findings.push_back(find_blender_engine());
  findings.push_back(find_embree());
  const std::string python = thermal::find_python().string();
  const std::string numpy =
      first_line({python, "-I", "-c",
                  "import sys, numpy; print(sys.version.split()[0], 'with NumPy', numpy.__version__)"});
  findings.push_back({"Python", numpy.empty() ? "" : numpy + ", " + python, "apt-get install python3-numpy"});
  for (const auto& [library, version] : thermal::library_versions())
    findings.push_back({library, version, ""});
  return findings;
}

bool is_there(const Finding& finding) { return !finding.found.empty(); }

/// Whether datasets can be made: everything is installed, and at least one engine.
bool is_enough(const std::vector<Finding>& findings) {
  const auto is_engine = [](const Finding& finding) { return !finding.needed_for.empty(); };
  return std::ranges::all_of(findings, [&](const Finding& one) { return is_engine(one) || is_there(one); }) &&
         std::ranges::any_of(findings, [&](const Finding& one) { return is_engine(one) && is_there(one); });
}

std::string text_of(const Finding& finding) {
  if (is_there(finding)) return finding.found;
  if (finding.needed_for.empty()) return "missing: " + finding.remedy;
  return fmt::format("missing, needed for {}: {}", finding.needed_for, finding.remedy);
}

int run_doctor(bool json) {
  const std::vector<Finding> findings = find_all();
  thermal::Json report = thermal::Json::array();
  for (const Finding& finding : findings) {
    if (!json) print("{:<20} {}\n", finding.what, text_of(finding));
    report.push_back({{"what", finding.what},
                      {"found", finding.found},
                      {"remedy", is_there(finding) ? "" : finding.remedy},
                      {"needed_for", finding.needed_for}});
  }
  if (json) print_json(report);
  return is_enough(findings) ? kDone : kFailed;
}

}  // namespace

void add_doctor(Parser& parser) {
  Command command =
      parser.add_command("doctor", "What is installed, which versions, what is missing and how to get it");
  command.footer("Example: veldt doctor --json");
  auto json = std::make_shared<bool>(false);
  command.add_flag("--json", *json, "Print JSON");
  command.runs([json](const CommonOptions& /*common*/) { return run_doctor(*json); });
}

}  // namespace veldt
