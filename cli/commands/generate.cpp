#include "dataset/run/generate.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/planning.h"
#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "dataset/dataset_file.h"
#include "dataset/dataset_index.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/options.h"
#include "dataset/run/passes_folder.h"
#include "dataset/run/render.h"
#include "io/assets.h"
#include "io/system/child_process.h"

namespace veldt {
namespace {

/// Value of an environment variable; empty if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// A scheduler's environment variables for the index of a job and the number of jobs.
struct Scheduler {
  const char* index = "";
  const char* count = "";
  const char* last = "";  ///< highest index of all jobs; empty: unknown
  int first = 0;          ///< index of the first job
  const char* rule = "";
};
constexpr std::array<Scheduler, 3> kSchedulers = {
    {{.index = "SLURM_ARRAY_TASK_ID",
      .count = "SLURM_ARRAY_TASK_COUNT",
      .last = "SLURM_ARRAY_TASK_MAX",
      .first = 0,
      .rule = "a whole array, from 0 to SLURM_ARRAY_TASK_COUNT - 1; for some of its tasks, give I/N"},
     {.index = "JOB_COMPLETION_INDEX",
      .count = "JOB_COMPLETIONS",
      .first = 0,
      .rule = "from 0 to JOB_COMPLETIONS - 1"},
     {.index = "CI_NODE_INDEX", .count = "CI_NODE_TOTAL", .first = 1, .rule = "from 1 to CI_NODE_TOTAL"}}};

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

bool is_shard(const thermal::Shard& shard) { return shard.index >= 0 && shard.index < shard.count; }

int read_variable(const char* name, const Environment& environment) {
  const std::string text = environment(name).value_or("nothing");
  if (const auto number = whole_number(text)) return *number;
  throw thermal::ConfigError(thermal::fault(name, text, "", "a whole number, for --shard auto"));
}

/// Tasks 3 and 5 of an array of 8 are an array of two: its shards of N = 2 would differ.
bool is_whole_array(const Scheduler& scheduler, const thermal::Shard& shard, const Environment& environment) {
  const std::string last = std::to_string(scheduler.first + shard.count - 1);
  return environment(scheduler.last).value_or(last) == last;
}

thermal::Shard shard_of(const Scheduler& scheduler, const Environment& environment) {
  const int index = read_variable(scheduler.index, environment);
  const thermal::Shard shard = {.index = index - scheduler.first,
                                .count = read_variable(scheduler.count, environment)};
  if (is_shard(shard) && is_whole_array(scheduler, shard, environment)) return shard;
  throw thermal::ConfigError(thermal::fault(fmt::format("{} of {}", scheduler.index, shard.count),
                                            std::to_string(index), "", scheduler.rule));
}

thermal::Shard shard_of_job(const Environment& environment) {
  for (const Scheduler& scheduler : kSchedulers)
    if (environment(scheduler.index)) return shard_of(scheduler, environment);
  throw thermal::ConfigError(
      thermal::fault("--shard", "auto", "",
                     "SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX or CI_NODE_INDEX in the environment"));
}

/// The process's own environment.
std::optional<std::string> own_environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

/// --shard: "I/N" with 0 <= I < N, or "auto": the index of this job in a Slurm array, a Kubernetes Indexed Job or a
/// parallel GitLab job. ConfigError for an invalid text, or invalid variables of that job.
thermal::Shard parse_shard(const std::string& text, const Environment& environment) {
  if (text == "auto") return shard_of_job(environment);
  const std::string_view all = text;
  const std::size_t slash = all.find('/');
  if (slash != std::string_view::npos) {
    const std::optional<int> index = whole_number(all.substr(0, slash));
    const std::optional<int> count = whole_number(all.substr(slash + 1));
    if (const thermal::Shard shard{index.value_or(-1), count.value_or(0)}; is_shard(shard)) return shard;
  }
  throw thermal::ConfigError(thermal::fault("--shard", text, "", "I/N with I from 0 to N - 1, or auto"));
}

/// Differences between generate and render.
struct Work {
  std::string command;
  std::string footer;
  thermal::CheckOut check;
  std::function<thermal::RunOutcome(const thermal::ResolvedConfig&, const thermal::DatasetPlan&,
                                    const thermal::GenerateOptions&, const thermal::RunHooks&)>
      run;
};

struct GenerateArguments {
  std::string config;
  std::string plan;
  std::string out;
  std::string scratch;
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

int make_preview(const thermal::ResolvedConfig& config, const std::string& name,
                 const thermal::GenerateOptions& request, const CommonOptions& common) {
  plan_with_progress(common, request.assets, [&](thermal::PlanOptions options) {
    options.blender = request.blender;
    options.preview = true;
    thermal::plan_in_dataset(request.out, config, name, options);
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

/// A given plan, whose config is complete, or a config with a plan made by this run.
thermal::PlannedDataset plan_of_run(const thermal::ResolvedConfig& config, const GenerateArguments& options,
                                    const thermal::GenerateOptions& request, const CommonOptions& common,
                                    const Work& work) {
  if (options.dry_run) return plan_with_progress(common, request.assets, config, options.config);
  thermal::PlannedDataset planned;
  plan_with_progress(common, request.assets, [&](thermal::PlanOptions planning) {
    planning.blender = request.blender;
    planned = thermal::plan_in_dataset(request.out, config, options.config, planning, work.check);
  });
  return planned;
}

/// Colour stills need Blender with every engine.
bool needs_blender(const GenerateArguments& options, const thermal::DatasetSpec& spec) {
  return !options.dry_run && (options.preview || spec.engine == thermal::Engine::blender);
}

void check_sources(const GenerateArguments& options, const std::string& command) {
  if (options.config.empty() && options.plan.empty())
    throw thermal::ConfigError("config or --plan is required; see veldt " + command + " --help");
  if (!options.config.empty() && !options.plan.empty())
    throw thermal::ConfigError("config and --plan exclude each other; see veldt " + command + " --help");
  if (!options.plan.empty() && !(options.settings.empty() && options.engine.empty()))
    throw thermal::ConfigError("--set and --engine change a config, not a plan; give them to veldt plan");
  if (!options.scratch.empty() && options.plan.empty())
    throw thermal::ConfigError("--scratch needs --plan, because a plan takes part of its place in --out");
  if (!options.scratch.empty() && options.keep_passes)
    throw thermal::ConfigError("--keep-passes and --scratch exclude each other: passes are kept in --out");
}

/// The given config, or a plan with its config.
thermal::PlannedDataset read_sources(const GenerateArguments& options, const thermal::Assets& assets) {
  if (!options.plan.empty()) return thermal::PlanStore(options.plan, assets).open();
  return {.config = load_config(options.config, with_engine(options.settings, options.engine), assets),
          .plan = {}};
}

int run_generate(const GenerateArguments& options, const CommonOptions& common, const Work& work) {
  check_max_unusable(options.max_unusable_share);
  check_sources(options, work.command);
  const thermal::Assets assets = thermal::Assets::find();
  thermal::PlannedDataset dataset = read_sources(options, assets);
  if (!common.quiet && !options.dry_run && !options.preview) print_engine(dataset.config.spec);
  const thermal::GenerateOptions request = {
      .assets = assets,
      .out = options.out,
      .plan = options.plan.empty() ? thermal::Layout{options.out}.plan() : thermal::Path(options.plan),
      .scratch = options.scratch,
      .blender = needs_blender(options, dataset.config.spec) ? find_blender(options.blender)
                                                             : thermal::find_program("blender"),
      .clips = options.clips,
      .shard = parse_shard(options.shard, own_environment),
      .jobs = options.jobs,
      .threads = common.threads,
      .keep_passes = options.keep_passes};
  if (dataset.config.spec.flights.empty())  // reports a wrong --clips at once
    (void)thermal::choose_clips(dataset.config.spec, request.clips, request.shard);
  if (options.preview && !options.dry_run)
    return make_preview(dataset.config, options.config, request, common);
  if (options.plan.empty()) dataset = plan_of_run(dataset.config, options, request, common, work);
  const auto& [config, plan] = dataset;
  const std::vector<thermal::ClipSpec> chosen =
      thermal::choose_clips(config.spec, request.clips, request.shard);
  if (options.dry_run) {
    print_plan(config.spec, plan, chosen);
    return kDone;
  }
  if (!options.plan.empty()) thermal::PlanStore(options.plan, assets).check_clips(thermal::ids_of(chosen));
  watch_for_stop();
  thermal::RunOutcome outcome;
  {
    ProgressBar bar(common, "building the scene");
    outcome = work.run(config, plan, request, hooks_for(bar));
  }
  return summarise(outcome, options.out, common, "made", options.max_unusable_share);
}

void add(Parser& parser, const std::string& description, const Work& work) {
  Command command = parser.add_command(work.command, description);
  command.footer(work.footer);
  auto options = std::make_shared<GenerateArguments>();
  command.add_option("config", options->config, "Config of the dataset, JSON");
  command
      .add_option(
          "--plan", options->plan,
          "A plan that veldt plan wrote, instead of a config: nothing is planned, so that any machine "
          "can make its part at once")
      .type_name("DIR");
  command.add_option("--out", options->out, "Folder of the dataset").required().type_name("DIR");
  command.add_option("--clips", options->clips, "Only these clips").comma_separated().type_name("ID,…");
  command
      .add_option(
          "--shard", options->shard,
          "Only the I-th of N shares of the clips, which cost nearly the same, I from 0 to N - 1; auto: by "
          "the job of a Slurm array, a Kubernetes Indexed Job or a parallel GitLab job")
      .type_name("I/N|auto");
  command
      .add_option("--jobs", options->jobs,
                  "Blender processes to run at once, one clip each; they share --threads, and each holds "
                  "the place in memory (embree uses all threads anyway)")
      .between(1, 64)
      .shows_default();
  add_engine(command, options->engine);
  command.add_option("--blender", options->blender, "Blender to use instead of the one on PATH")
      .type_name("PATH");
  if (work.command == "generate") {
    command
        .add_option(
            "--scratch", options->scratch,
            "Make clips in this folder, of this run alone, such as a disk of the node, and copy each to "
            "--out when complete, which may be a mounted object store")
        .type_name("DIR");
    command.add_flag("--keep-passes", options->keep_passes,
                     "Keep the rendered EXR passes, for veldt convert");
    add_max_unusable(command, options->max_unusable_share);
  }
  if (work.command == "render") {
    command.add_flag("--preview", options->preview,
                     "Render a map of the place and colour stills to look at, instead of passes");
  }
  add_settings(command, options->settings);
  command.add_flag("--dry-run", options->dry_run, "Check the config and print what would be made");
  command.runs([options, work](const CommonOptions& common) { return run_generate(*options, common, work); });
}

}  // namespace

void add_generate(Parser& parser) {
  add(parser, "Make a dataset from a config; resumes where an earlier run stopped",
      {.command = "generate",
       .footer =
           "If a run is interrupted, the same command continues it, and the pixels are the same as without\n"
           "the interruption. A finished dataset is left unchanged. A clip that cannot be made does not\n"
           "stop the others: the exit code is 3, dataset.json has the reason, and the next run tries it\n"
           "again.\n"
           "Example: veldt generate configs/demo.json --out my_dataset",
       .check = thermal::check_same_dataset,
       .run = thermal::generate});
}

void add_render(Parser& parser) {
  add(parser, "Render passes and manifests only",
      {.command = "render",
       .footer = "Example: veldt render configs/savanna.json --out look --preview",
       .check = thermal::check_same_passes,
       .run = [](const auto& config, const auto& /*plan*/, const auto& request, const auto& hooks) {
         return thermal::render(config, request, hooks);
       }});
}

}  // namespace veldt
