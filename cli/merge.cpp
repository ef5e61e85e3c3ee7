#include "dataset/run/merge.h"

#include <cstdio>
#include <memory>

#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/run_summary.h"
#include "cli/stop_signal.h"

namespace veldt {
namespace {

struct MergeArguments {
  std::vector<std::string> sources;
  std::string out;
  std::string link = "hard";
};

void print_missing(const thermal::MergeOutcome& outcome, const MergeArguments& options) {
  if (outcome.missing.empty()) return;
  print_error("veldt: {} lacks clips {}; none of {} has them complete\n", options.out,
              thermal::list_names(outcome.missing), thermal::list_names(options.sources));
}

int run_merge(const MergeArguments& options, const CommonOptions& common) {
  watch_for_stop();
  thermal::MergeOutcome outcome;
  {
    ProgressBar bar(common);
    outcome =
        thermal::merge({.sources = {options.sources.begin(), options.sources.end()},
                        .out = options.out,
                        .linking = options.link == "hard" ? thermal::Linking::hard : thermal::Linking::copy},
                       hooks_for(bar));
  }
  print_missing(outcome, options);
  const int code = summarise(outcome.run, options.out, common, "merged");
  return code == kDone && !outcome.missing.empty() ? kSomeRejected : code;
}

}  // namespace

void add_merge(CLI::App& app, Session& session) {
  CLI::App* command = add_command(app, session, "merge", "Join datasets made as shards of one config");
  auto options = std::make_shared<MergeArguments>();
  command
      ->add_option("dirs", options->sources, "Datasets, each with some of the config's clips; never modified")
      ->required()
      ->type_name("DIR…");
  command->add_option("--out", options->out, "Folder of the joined dataset")->required();
  command->add_option("--link", options->link, "Hard links where the file system supports them, or copies")
      ->check(CLI::IsMember({"hard", "copy"}))
      ->capture_default_str();
  command->callback([options, &session] {
    session.run = [options, &session] { return run_merge(*options, session.common); };
  });
}

}  // namespace veldt
