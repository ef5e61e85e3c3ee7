#include "dataset/convert.h"

#include <memory>

#include "base/error.h"
#include "cli/command.h"
#include "cli/progress_bar.h"
#include "cli/read_limits.h"
#include "cli/run_summary.h"
#include "cli/stop_signal.h"
#include "io/resources.h"

namespace veldt {
namespace {

struct ConvertArguments {
  std::vector<std::string> passes;
  std::string out;
  std::string manifest;
  std::string config;
  std::string variants;
  std::vector<std::string> settings;
  double max_megapixels = 256;
  double max_unusable_share = kMostUnusable;
  bool strict = false;
};

std::optional<thermal::Json> read_document(const std::string& file) {
  if (file.empty()) return std::nullopt;
  try {
    return thermal::read_json(file);
  } catch (const thermal::IoError& error) {
    throw thermal::ConfigError(error.what());
  }
}

int run_convert(const ConvertArguments& options, const CommonOptions& common) {
  check_max_unusable(options.max_unusable_share);
  thermal::ConvertOptions request = {.home = thermal::find_home(),
                                     .passes = {options.passes.begin(), options.passes.end()},
                                     .manifest = options.manifest,
                                     .config = read_document(options.config),
                                     .config_name = options.config,
                                     .settings = options.settings,
                                     .variants = read_document(options.variants),
                                     .variants_name = options.variants,
                                     .out = options.out,
                                     .limits = read_limits(options.max_megapixels),
                                     .strict = options.strict,
                                     .threads = common.threads};
  watch_for_stop();
  std::vector<thermal::ConvertOutcome> outcomes;
  {
    ProgressBar bar(common);
    outcomes = thermal::convert(request, hooks_for(bar));
  }
  return summarise(outcomes, common, options.max_unusable_share);
}

}  // namespace

void add_convert(CLI::App& app, Session& session) {
  CLI::App* command = add_command(app, session, "convert", "Turn rendered passes into frames and labels");
  auto options = std::make_shared<ConvertArguments>();
  command
      ->add_option("passes", options->passes,
                   "Passes, one clip per folder: folders with a manifest.json, files, or quoted "
                   "patterns such as \"r/f_####.exr\"")
      ->required();
  command->add_option("--out", options->out, "Folder of the dataset")->required();
  command->add_option("--manifest", options->manifest, "Manifest to use instead of the folder's")
      ->type_name("FILE");
  command->add_option("--config", options->config, "Config to take season, seed and sensor from")
      ->type_name("FILE");
  command
      ->add_option("--variants", options->variants,
                   "List of changes to the config; each makes a dataset in a folder of its name, and passes "
                   "are read once")
      ->type_name("FILE");
  add_settings(command, options->settings);
  add_max_megapixels(command, options->max_megapixels);
  add_max_unusable(command, options->max_unusable_share);
  command->add_flag("--strict", options->strict,
                    "Stop at the first bad frame instead of reporting it and skipping it");
  command->callback([options, &session] {
    session.run = [options, &session] { return run_convert(*options, session.common); };
  });
}

}  // namespace veldt
