#include "dataset/run/generate.h"

#include <algorithm>
#include <charconv>
#include <memory>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/plan_table.h"
#include "cli/planning.h"
#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "cli/stop_signal.h"
#include "dataset/layout.h"
#include "dataset/run/clip_choice.h"
#include "dataset/run/planning.h"
#include "dataset/run/render.h"
#include "io/assets.h"
#include "io/system/child_process.h"

namespace veldt {
namespace {

/// What generate and render do differently.
struct Work {
  std::function<thermal::DatasetPlan(const thermal::Path& out, const thermal::Config&,
                                     const std::string& name, const thermal::PlanOptions&)>
      plan;
  std::function<thermal::RunOutcome(const thermal::Config&, const thermal::DatasetPlan&,
                                    const thermal::GenerateOptions&, const thermal::RunHooks&)>
      run;
};

struct GenerateArguments {
  std::string config;
  std::string out;
  std::string blender;
  std::string engine;
  std::string shard = "0/1";
  std::vector<std::string> clips;
  std::vector<std::string> settings;
  double max_unusable_share = kMostUnusable;
  int jobs = 1;
  bool keep_passes = false;
  bool preview = false;
  bool dry_run = false;
};

/// "I/N", 0 <= I < N.
thermal::Shard parse_shard(const std::string& text) {
  thermal::Shard shard;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, shard.count) : first;
  const bool good = slash && second.ec == std::errc() && second.ptr == end;
  if (good && shard.index >= 0 && shard.index < shard.count) return shard;
  throw thermal::ConfigError(thermal::fault("--shard", text, "", "I/N with I from 0 to N - 1"));
}

int make_preview(const thermal::Config& config, const std::string& name,
                 const thermal::GenerateOptions& request, const CommonOptions& common) {
  (void)plan_with_progress(common, request.assets, [&](thermal::PlanOptions options) {
    options.blender = request.blender;
    return thermal::plan_to_preview(request.out, config, name, options);
  });
  watch_for_stop();
  int pictures = 0;
  {
    ProgressBar bar(common, "building the scene");
    pictures = thermal::preview(config, request, hooks_for(bar));
  }
  const thermal::Path folder = thermal::Layout{request.out}.preview();
  if (!common.quiet)
    print("{}: {} pictures; map.png shows the place from above\n", folder.string(), pictures);
  return kDone;
}

thermal::DatasetPlan plan_of_run(const thermal::Config& config, const GenerateArguments& options,
                                 const thermal::GenerateOptions& request, const CommonOptions& common,
                                 const Work& work) {
  if (options.dry_run) return plan_with_progress(common, request.assets, config, options.config);
  return plan_with_progress(common, request.assets, [&](thermal::PlanOptions planning) {
    planning.blender = request.blender;
    return work.plan(request.out, config, options.config, planning);
  });
}

/// Blender renders colour stills for every engine.
bool needs_blender(const GenerateArguments& options, const thermal::Config& config) {
  return !options.dry_run && (options.preview || config.engine == thermal::Engine::blender);
}

int run_generate(const GenerateArguments& options, const CommonOptions& common, const Work& work) {
  check_max_unusable(options.max_unusable_share);
  const thermal::Assets assets = thermal::Assets::find();
  std::vector<std::string> settings = options.settings;
  if (!options.engine.empty()) settings.push_back("render.engine=" + options.engine);
  const thermal::Config given = load_config(options.config, settings, assets);
  const thermal::GenerateOptions request = {.assets = assets,
                                            .out = options.out,
                                            .blender = needs_blender(options, given)
                                                           ? find_blender(options.blender)
                                                           : thermal::find_program("blender"),
                                            .clips = options.clips,
                                            .shard = parse_shard(options.shard),
                                            .jobs = options.jobs,
                                            .threads = common.threads,
                                            .keep_passes = options.keep_passes};
  if (given.flights.empty())  // then wrong --clips can be reported at once
    (void)thermal::choose_clips(given, request.clips, request.shard);
  if (options.preview && !options.dry_run) return make_preview(given, options.config, request, common);
  const thermal::DatasetPlan plan = plan_of_run(given, options, request, common, work);
  const thermal::Config config = thermal::with_flights_cut(given, plan);
  const std::vector<thermal::ClipConfig> chosen = thermal::choose_clips(config, request.clips, request.shard);
  if (options.dry_run) {
    print_plan(config, plan, chosen);
    return kDone;
  }
  watch_for_stop();
  thermal::RunOutcome outcome;
  {
    ProgressBar bar(common, "building the scene");
    outcome = work.run(config, plan, request, hooks_for(bar));
  }
  return summarise(outcome, options.out, common, "made", options.max_unusable_share);
}

void add(CLI::App& app, Session& session, const std::string& name, const std::string& description,
         const Work& work) {
  CLI::App* command = add_command(app, session, name, description);
  auto options = std::make_shared<GenerateArguments>();
  command->add_option("config", options->config, "Config of the dataset, JSON")->required();
  command->add_option("--out", options->out, "Folder of the dataset")->required();
  command->add_option("--clips", options->clips, "Only these clips")
      ->delimiter(',')
      ->allow_extra_args(false)  // otherwise a CONFIG that follows would be read as a clip
      ->type_name("ID,…");
  command->add_option("--shard", options->shard, "Only every N-th clip, from the I-th")->type_name("I/N");
  command
      ->add_option("--jobs", options->jobs,
                   "Blender processes to run at once, one clip each; they share --threads, and each holds "
                   "the place in memory (embree uses all threads anyway)")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command
      ->add_option(
          "--engine", options->engine,
          "What renders: blender, or embree, which is much faster (default: render.engine of the config)")
      ->check(CLI::IsMember({"blender", "embree"}))
      ->type_name("NAME");
  command->add_option("--blender", options->blender, "Blender to use instead of the one on PATH")
      ->type_name("PATH");
  if (name == "generate") {
    command->add_flag("--keep-passes", options->keep_passes,
                      "Keep the rendered EXR passes, for veldt convert");
    add_max_unusable(command, options->max_unusable_share);
  }
  if (name == "render") {
    command->add_flag("--preview", options->preview,
                      "Render a map of the place and colour stills to look at, instead of passes");
  }
  add_settings(command, options->settings);
  command->add_flag("--dry-run", options->dry_run, "Check the config and print what would be made");
  command->callback([options, &session, work] {
    session.run = [options, &session, work] { return run_generate(*options, session.common, work); };
  });
}

}  // namespace

void add_generate(CLI::App& app, Session& session) {
  add(app, session, "generate", "Make a dataset from a config; resumes where an earlier run stopped",
      {.plan = thermal::plan_to_generate, .run = thermal::generate});
}

void add_render(CLI::App& app, Session& session) {
  add(app, session, "render", "Render passes and manifests only",
      {.plan = thermal::plan_to_render, .run = thermal::render});
}

}  // namespace veldt
