#include <memory>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/planning.h"
#include "dataset/plan/plan_store.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct PlanArguments {
  std::string config;
  std::string out;
  std::string blender;
  std::string engine;
  std::vector<std::string> settings;
};

/// Only a plan may be overwritten.
void check_out(const thermal::Path& out, const thermal::PlanStore& store) {
  const bool is_taken = std::filesystem::exists(out) &&
                        (!std::filesystem::is_directory(out) || !std::filesystem::is_empty(out));
  if (!is_taken || store.exists()) return;
  throw thermal::ConfigError(thermal::fault("--out", out.string(), "", "an empty folder, or a plan"));
}

int run_plan(const PlanArguments& options, const CommonOptions& common) {
  const thermal::Assets assets = thermal::Assets::find();
  const thermal::ResolvedConfig given =
      load_config(options.config, with_engine(options.settings, options.engine), assets);
  // Without a trailing slash: the plan is built beside the folder.
  const thermal::Path out = std::filesystem::absolute(options.out + "/").lexically_normal().parent_path();
  const thermal::PlanStore store(out, assets);
  check_out(options.out, store);
  thermal::PlannedDataset dataset;
  plan_with_progress(common, assets, [&](thermal::PlanOptions planning) {
    if (!options.blender.empty()) planning.blender = find_blender(options.blender);
    dataset = store.plan_with_config(given, options.config, planning);
  });
  if (!common.quiet) print_plan(dataset.config.spec, dataset.plan, dataset.config.spec.clips);
  return kDone;
}

}  // namespace

void add_plan(Parser& parser) {
  Command command = parser.add_command("plan", "Plan a dataset and bake its scene, without a renderer");
  command.footer(
      "A plan has all that any machine needs to make its part of a dataset with veldt generate --plan: the\n"
      "config with its defaults, the scene and all paths, with checksums.\n"
      "Example: veldt plan configs/savanna.json --out plan");
  auto options = std::make_shared<PlanArguments>();
  command.add_option("config", options->config, "Config of a dataset, JSON").required();
  command.add_option("--out", options->out, "Folder of the plan").required().type_name("DIR");
  add_engine(command, options->engine);
  command.add_option("--blender", options->blender, "Blender that reads 3D models, if not the one on PATH")
      .type_name("PATH");
  add_settings(command, options->settings);
  command.runs([options](const CommonOptions& common) { return run_plan(*options, common); });
}

}  // namespace veldt
