#include <memory>

#include "base/error.h"
#include "cli/command.h"
#include "cli/inspection_table.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/read_limits.h"
#include "cli/stop_signal.h"
#include "io/assets.h"

namespace veldt {
namespace {

using thermal::Inspection;
using thermal::Path;

struct InspectArguments {
  std::vector<std::string> passes;
  std::string manifest;
  std::string layer;
  std::string starter;
  double max_megapixels = 256;
  bool all_frames = false;
  bool json = false;
};

thermal::InspectOptions request_of(const InspectArguments& options) {
  return {.assets = thermal::Assets::find(),
          .passes = {options.passes.begin(), options.passes.end()},
          .manifest = options.manifest,
          .layer = options.layer,
          .all_frames = options.all_frames || !options.starter.empty(),
          .for_starter = !options.starter.empty(),
          .limits = read_limits(options.max_megapixels)};
}

/// Called before any frame is read, because reading all of them may take a while.
void check_starter(const Path& file) {
  if (file.empty()) return;
  const auto refuse = [&file](const char* rule) {
    throw thermal::ConfigError(thermal::fault("--starter-manifest", file.string(), "", rule));
  };
  if (std::filesystem::exists(file)) refuse("a file that does not exist yet");
  if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path()))
    refuse("a file in an existing folder");
}

Inspection inspect(const InspectArguments& options, const CommonOptions& common) {
  watch_for_stop();
  ProgressBar bar(common);
  return thermal::inspect(request_of(options), hooks_for(bar));
}

void write_starter(const Inspection& inspection, const InspectArguments& options) {
  const thermal::StarterManifest starter =
      thermal::starter_manifest(inspection, thermal::NameGuesser(thermal::Assets::find()));
  thermal::write_file_atomically(options.starter, thermal::to_text(starter.document));
  if (!options.json) print_starter(starter, inspection, options.starter);
}

int run_inspect(const InspectArguments& options, const CommonOptions& common) {
  check_starter(options.starter);
  const Inspection inspection = inspect(options, common);
  options.json ? print_json(to_json(inspection)) : print_inspection(inspection);
  if (!options.starter.empty()) write_starter(inspection, options);
  return kDone;
}

}  // namespace

void add_inspect(CLI::App& app, Session& session) {
  CLI::App* command =
      add_command(app, session, "inspect", "What is in these passes, and what convert would do with them");
  command->footer("Example: veldt inspect passes --starter-manifest passes/manifest.json");
  auto options = std::make_shared<InspectArguments>();
  command
      ->add_option(
          "passes", options->passes,
          "A folder of passes; or files, or a quoted pattern such as \"r/f_####.exr\", of one folder")
      ->required();
  CLI::Option* manifest =
      command->add_option("--manifest", options->manifest, "Manifest to use instead of the folder's")
          ->type_name("FILE");
  command->add_option("--layer", options->layer, "Layer of an EXR file that has several")->type_name("NAME");
  command->add_flag("--all-frames", options->all_frames, "Inspect every frame, not only the first");
  command
      ->add_option("--starter-manifest", options->starter,
                   "Inspect every frame and write a manifest to fill in; never overwrites a file")
      ->type_name("FILE")
      ->excludes(manifest);
  add_max_megapixels(command, options->max_megapixels);
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &session] {
    session.run = [options, &session] { return run_inspect(*options, session.common); };
  });
}

}  // namespace veldt
