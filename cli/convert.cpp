#include "dataset/convert.h"

#include <memory>

#include "base/error.h"
#include "cli/command.h"
#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "cli/stop_signal.h"
#include "io/resources.h"

namespace veldt {
namespace {

struct Options {
  std::vector<std::string> passes;
  std::string out;
  std::string manifest;
  std::string config;
  std::vector<std::string> settings;
};

std::optional<thermal::Json> read_config(const std::string& file) {
  if (file.empty()) return std::nullopt;
  try {
    return thermal::read_json(file);
  } catch (const thermal::IoError& error) {
    throw thermal::ConfigError(error.what());
  }
}

int run(const Options& options, const CommonOptions& common) {
  thermal::ConvertOptions request = {.home = thermal::find_home(),
                                     .passes = {options.passes.begin(), options.passes.end()},
                                     .manifest = options.manifest,
                                     .config = read_config(options.config),
                                     .config_name = options.config,
                                     .settings = options.settings,
                                     .out = options.out,
                                     .threads = common.threads};
  watch_for_stop();
  thermal::RunOutcome outcome;
  {
    ProgressBar bar(common);
    outcome = thermal::convert(request, hooks_for(bar));
  }
  return summarise(outcome, options.out, common);
}

}  // namespace

void add_convert(CLI::App& app, Session& session) {
  CLI::App* command = add_command(app, session, "convert", "Turn rendered passes into frames and labels");
  auto options = std::make_shared<Options>();
  command->add_option("passes", options->passes, "Folders of EXR passes, a clip each, with a manifest.json")
      ->required();
  command->add_option("--out", options->out, "Folder of the dataset")->required();
  command->add_option("--manifest", options->manifest, "Manifest to use instead of the folder's")
      ->type_name("FILE");
  command->add_option("--config", options->config, "Config to take season, seed and sensor from")
      ->type_name("FILE");
  command
      ->add_option("--set", options->settings,
                   "Change the config, e.g. season=summer sensor.blur_sigma_px=0.5")
      ->type_name("KEY=VALUE");
  command->callback(
      [options, &session] { session.run = [options, &session] { return run(*options, session.common); }; });
}

}  // namespace veldt
