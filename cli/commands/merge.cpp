#include "dataset/run/merge.h"

#include <cstdio>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "dataset/plan/plan_store.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct MergeArguments {
  std::vector<std::string> sources;
  std::string out;
  std::string plan;
  std::string link = "hard";
  int shards = 0;
};

constexpr std::size_t kMostListed = 8;

/// Lists the shards to repeat in the format of schedulers' arrays: 3,5.
void print_shards(const thermal::MergeOutcome& outcome, const MergeArguments& options) {
  if (outcome.shards_to_make.empty()) return;
  print_error("veldt: run these of {} shards again: {}\n", options.shards,
              fmt::format("{}", fmt::join(outcome.shards_to_make, ",")));
}

void print_missing(const thermal::MergeOutcome& outcome, const MergeArguments& options) {
  for (const auto& [source, why] : outcome.left_out)
    print_error("veldt: {} is left out: {}\n", source.string(), why);
  if (!outcome.missing.empty())
    print_error("veldt: {} lacks clips {}; none of {} has them complete\n", options.out,
                thermal::list_names(outcome.missing, kMostListed),
                thermal::list_names(options.sources, kMostListed));
  print_shards(outcome, options);
}

void check_arguments(const MergeArguments& options) {
  if (options.shards > 0 && options.plan.empty())
    throw thermal::ConfigError("--shards needs --plan, which says what each shard makes");
}

std::optional<thermal::ResolvedConfig> planned_config(const MergeArguments& options) {
  if (options.plan.empty()) return std::nullopt;
  return thermal::PlanStore(options.plan, thermal::Assets::find()).open().config;
}

int run_merge(const MergeArguments& options, const CommonOptions& common) {
  check_arguments(options);
  watch_for_stop();
  thermal::MergeOutcome outcome;
  {
    ProgressBar bar(common);
    outcome =
        thermal::merge({.sources = {options.sources.begin(), options.sources.end()},
                        .out = options.out,
                        .config = planned_config(options),
                        .shards = options.shards,
                        .linking = options.link == "hard" ? thermal::Linking::hard : thermal::Linking::copy},
                       hooks_for(bar));
  }
  print_missing(outcome, options);
  const int code = summarise(outcome.run, options.out, common, "merged");
  return code == kDone && !outcome.missing.empty() ? kSomeRejected : code;
}

}  // namespace

void add_merge(Parser& parser) {
  Command command = parser.add_command("merge", "Join datasets made as shards of one config");
  command.footer(
      "The result is the same, bit for bit, as that of one run. With --plan and --shards, the shards to\n"
      "run again are listed if clips are missing.\n"
      "Example: veldt merge --plan plan --shards 8 shards/* --out my_dataset");
  auto options = std::make_shared<MergeArguments>();
  command
      .add_option("dirs", options->sources, "Datasets, each with some of the config's clips; never modified")
      .required()
      .type_name("DIR…");
  command.add_option("--out", options->out, "Folder of the joined dataset").required().type_name("DIR");
  command
      .add_option(
          "--plan", options->plan,
          "The plan that the shards were made from: they must have its config. Folders of DIR without a "
          "dataset are then named and left out")
      .type_name("DIR");
  command.add_option("--shards", options->shards, "Number N of shards I/N: those to make again are listed")
      .between(1, 1'000'000)
      .type_name("N");
  command.add_option("--link", options->link, "Hard links where the file system supports them, or copies")
      .one_of({"hard", "copy"})
      .shows_default();
  command.runs([options](const CommonOptions& common) { return run_merge(*options, common); });
}

}  // namespace veldt
