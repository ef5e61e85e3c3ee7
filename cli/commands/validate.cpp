#include "dataset/inspect/validate.h"

#include <memory>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/planning.h"
#include "cli/progress_bar.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct ValidateArguments {
  std::string what;
  std::vector<std::string> settings;
  bool json = false;
};

thermal::DatasetCheck check_dataset(const std::string& folder, const CommonOptions& common) {
  ProgressBar bar(common, "starting", "clips", kClipPatience);
  return thermal::validate_dataset(folder, {.progress = hooks_for(bar).progress, .cancelled = {}});
}

int validate_dataset(const ValidateArguments& options, const CommonOptions& common) {
  if (!options.settings.empty()) {
    throw thermal::ConfigError(
        thermal::fault("--set", options.settings.front(), "", "a config to check, not a dataset"));
  }
  const thermal::DatasetCheck check = check_dataset(options.what, common);
  if (options.json) {
    const thermal::Json report = {{"dataset", options.what},
                                  {"valid", check.faults.empty()},
                                  {"clips", check.clips},
                                  {"files", check.files},
                                  {"faults", check.faults}};
    print_json(report);
  } else {
    for (const std::string& fault : check.faults) print("{}\n", fault);
    print("{}: {} clips, {} files checked, {}\n", options.what, check.clips, check.files,
          check.faults.empty() ? "all unchanged" : fmt::format("{} faults", check.faults.size()));
  }
  return check.faults.empty() ? kDone : kFailed;
}

int validate_config(const ValidateArguments& options, const CommonOptions& common) {
  const thermal::Assets assets = thermal::Assets::find();
  const thermal::ResolvedConfig config = load_config(options.what, options.settings, assets);
  const auto plan = plan_with_progress(common, assets, config, options.what).plan.clips;
  int frames = 0;
  int with_actors = 0;
  for (const thermal::ClipPlan& clip : plan) {
    frames += clip.frames;
    with_actors += clip.frames_with_actors;
  }
  if (options.json) {
    const thermal::Json report = {{"config", options.what},
                                  {"valid", true},
                                  {"clips", plan.size()},
                                  {"frames", frames},
                                  {"frames_with_actors", with_actors}};
    print_json(report);
  } else {
    print("{}: {} clips, {} frames, {} with actors in view\n", options.what, plan.size(), frames,
          with_actors);
  }
  return kDone;
}

}  // namespace

void add_validate(Parser& parser) {
  Command command = parser.add_command(
      "validate", "Check a config (schema and meaning) or a dataset (complete, every file unchanged)");
  command.footer("Example: veldt validate configs/demo.json --set season=summer");
  auto options = std::make_shared<ValidateArguments>();
  command.add_option("what", options->what, "A config, or the folder of a dataset").required();
  add_settings(command, options->settings);
  command.add_flag("--json", options->json, "Report as JSON");
  command.runs([options](const CommonOptions& common) {
    return std::filesystem::is_directory(options->what) ? validate_dataset(*options, common)
                                                        : validate_config(*options, common);
  });
}

}  // namespace veldt
