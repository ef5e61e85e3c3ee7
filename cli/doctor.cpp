#include <algorithm>
#include <memory>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/version.h"
#include "cli/command.h"
#include "cli/output.h"
#include "dataset/plan/planning.h"
#include "io/assets.h"
#include "io/system/child_process.h"
#include "io/system/cores.h"
#include "io/system/versions.h"

namespace veldt {
namespace {

/// One thing to look for.
struct Finding {
  std::string what;
  std::string found;   ///< version and path; empty if missing
  std::string remedy;  ///< how to get it
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

/// How many cores commands use without --threads, and what keeps them from using all.
std::string describe(const thermal::Cores& cores) {
  std::string text = fmt::format("{} usable of {}", cores.usable(), cores.machine);
  if (cores.usable() < cores.affinity)
    return fmt::format("{}: a control group limits CPU time to {:.2f} cores", text, *cores.limit);
  if (cores.affinity < cores.machine) return fmt::format("{}: CPU affinity allows {}", text, cores.affinity);
  return text;
}

std::vector<Finding> look() {
  std::vector<Finding> findings = {{"veldt", std::string(thermal::kVersion), ""}, find_home()};
  findings.push_back({"cores", describe(thermal::find_cores()), ""});
  const std::string blender = thermal::find_program("blender").string();
  const std::string blender_version = first_line({blender, "--version"});
  findings.push_back({"Blender", blender_version.empty() ? "" : blender_version + ", " + blender,
                      "apt-get install blender, or name one with --blender PATH"});
  const std::string python = thermal::find_python().string();
  const std::string numpy =
      first_line({python, "-I", "-c",
                  "import sys, numpy; print(sys.version.split()[0], 'with NumPy', numpy.__version__)"});
  findings.push_back({"Python", numpy.empty() ? "" : numpy + ", " + python, "apt-get install python3-numpy"});
  for (const auto& [library, version] : thermal::library_versions())
    findings.push_back({library, version, ""});
  return findings;
}

int run_doctor(bool json) {
  const std::vector<Finding> findings = look();
  bool all_there = true;
  thermal::Json report = thermal::Json::array();
  for (const Finding& finding : findings) {
    const bool there = !finding.found.empty();
    all_there &= there;
    if (json) {
      report.push_back(
          {{"what", finding.what}, {"found", finding.found}, {"remedy", there ? "" : finding.remedy}});
    } else {
      print("{:<20} {}\n", finding.what, there ? finding.found : "missing: " + finding.remedy);
    }
  }
  if (json) print_json(report);
  return all_there ? kDone : kFailed;
}

}  // namespace

void add_doctor(CLI::App& app, Session& session) {
  CLI::App* command = add_command(app, session, "doctor",
                                  "What is installed, which versions, what is missing and how to get it");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->callback([json, &session] { session.run = [json] { return run_doctor(*json); }; });
}

}  // namespace veldt
