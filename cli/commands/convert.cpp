#include "dataset/run/convert.h"

#include <memory>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "io/assets.h"

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
  bool dry_run = false;
};

std::optional<thermal::Json> read_document(const std::string& file) {
  if (file.empty()) return std::nullopt;
  return read_named_document(file);
}

const char* in_words(thermal::ConvertStep::Action action) {
  switch (action) {
    case thermal::ConvertStep::Action::make:
      return "make";
    case thermal::ConvertStep::Action::make_again:
      return "make again";
    case thermal::ConvertStep::Action::keep:
      return "keep";
  }
  return "";
}

void print_forecast(const thermal::ConvertForecast& forecast) {
  int clips = 0;
  int frames = 0;
  print("{:<48} {:>8}  what to do\n", forecast.out.string() + ": clip", "frames");
  for (const thermal::ConvertStep& step : forecast.steps) {
    print("{:<48} {:>8}  {}\n", step.clip, step.frames, in_words(step.action));
    if (step.action == thermal::ConvertStep::Action::keep) continue;
    ++clips;
    frames += step.frames;
  }
  for (const std::string& term : forecast.left_out) print("without the term {}\n", term);
  print("{} of {} clips to make, {} frames\n", clips, forecast.steps.size(), frames);
}

int run_convert(const ConvertArguments& options, const CommonOptions& common) {
  check_max_unusable(options.max_unusable_share);
  thermal::ConvertOptions request = {.assets = thermal::Assets::find(),
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
  if (options.dry_run) {
    for (const thermal::ConvertForecast& forecast : thermal::forecast_convert(request))
      print_forecast(forecast);
    return kDone;
  }
  watch_for_stop();
  std::vector<thermal::ConvertOutcome> outcomes;
  {
    ProgressBar bar(common);
    outcomes = thermal::convert(request, hooks_for(bar));
  }
  return summarise(outcomes, common, options.max_unusable_share);
}

}  // namespace

void add_convert(Parser& parser) {
  Command command = parser.add_command("convert", "Turn rendered passes into frames and labels");
  command.footer(
      "The passes may come from any renderer that shows which object each pixel belongs to; veldt inspect\n"
      "says what their manifest lacks. A frame that cannot be converted is named and left out, and the\n"
      "exit code is 3.\n"
      "Example: veldt convert passes --out my_dataset --set sensor.model=physical season=summer");
  auto options = std::make_shared<ConvertArguments>();
  command
      .add_option("passes", options->passes,
                  "Passes, one clip per folder: folders with a manifest.json, files, or quoted "
                  "patterns such as \"r/f_####.exr\"")
      .required();
  command.add_option("--out", options->out, "Folder of the dataset").required().type_name("DIR");
  command.add_option("--manifest", options->manifest, "Manifest to use instead of the folder's")
      .type_name("FILE");
  command.add_option("--config", options->config, "Config to take season, seed and sensor from")
      .type_name("FILE");
  command
      .add_option("--variants", options->variants,
                  "List of changes to the config; each makes a dataset in a folder of its name, and passes "
                  "are read once")
      .type_name("FILE");
  add_settings(command, options->settings);
  add_max_megapixels(command, options->max_megapixels);
  add_max_unusable(command, options->max_unusable_share);
  command.add_flag("--strict", options->strict,
                   "Stop at the first bad frame instead of reporting it and skipping it");
  command.add_flag(
      "--dry-run", options->dry_run,
      "Check the request and the manifests, and print what would be made, without writing anything");
  command.runs([options](const CommonOptions& common) { return run_convert(*options, common); });
}

}  // namespace veldt
