#include <chrono>
#include <memory>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "cli/balance_table.h"
#include "cli/class_bounds.h"
#include "cli/command.h"
#include "cli/output.h"
#include "dataset/label_source.h"

namespace veldt {
namespace {

struct BalanceArguments {
  std::vector<std::string> datasets;
  std::vector<std::string> per_class;
  std::string out;
  std::uint32_t seed = 0;
  thermal::BalanceOptions balance;
  bool json = false;
};

/// An existing file may be replaced only if it is a selection.
void check_out(const BalanceArguments& options) {
  const thermal::Path out = options.out;
  if (!out.parent_path().empty() && !std::filesystem::is_directory(out.parent_path()))
    throw thermal::ConfigError(thermal::fault("--out", options.out, "", "a file in an existing folder"));
  if (!std::filesystem::exists(out)) return;
  try {
    (void)thermal::read_selection(out);
  } catch (const thermal::Error&) {
    throw thermal::ConfigError(
        thermal::fault("--out", options.out, "", "a new file, or a selection to replace"));
  }
}

std::vector<thermal::LabelSource> read_sources(const BalanceArguments& options) {
  std::vector<thermal::LabelSource> sources;
  std::set<thermal::Path> seen;
  for (const std::string& path : options.datasets) {
    std::error_code error;
    if (!seen.insert(std::filesystem::weakly_canonical(path, error)).second)
      throw thermal::ConfigError(thermal::fault("DATASET", path, "", "each dataset once"));
    sources.push_back({.path = path, .labels = thermal::read_labels(path)});
  }
  return sources;
}

void check_labels(const std::vector<thermal::BalanceVideo>& videos, const BalanceArguments& options) {
  for (const thermal::BalanceVideo& video : videos) {
    if (!video.types.empty()) return;
  }
  throw thermal::DataError(thermal::list_names(options.datasets) +
                           ": no labels of animals or people that count; expected at least one");
}

Balanced balance_sources(const BalanceArguments& options) {
  Balanced done;
  done.program.bounds = parse_class_bounds(options.per_class);
  check_out(options);
  done.sources = read_sources(options);
  done.program.videos = thermal::videos_of(done.sources);
  check_labels(done.program.videos, options);
  const auto begin = std::chrono::steady_clock::now();
  done.result = thermal::balance(done.program, options.balance);
  done.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  done.selection = thermal::select_frames(done.sources, done.program, done.result, options.seed);
  return done;
}

int run_balance(const BalanceArguments& options, bool quiet) {
  const Balanced done = balance_sources(options);
  thermal::write_selection(options.out, done.selection);
  if (options.json) print_json(to_json(done));
  if (!options.json && !quiet) {
    print_table(done);
    print("{}: written\n", options.out);
  }
  if (!done.result.in_time)
    print_error("veldt: stopped after {} s with a gap of {:.2f} %; {} % was requested\n",
                options.balance.time_limit_s, 100 * done.result.gap, 100 * options.balance.gap);
  return kDone;
}

}  // namespace

void add_balance(CLI::App& app, Session& session) {
  CLI::App* command =
      add_command(app, session, "balance",
                  "Select frames so that small, medium and large animals and poachers are drawn\n"
                  "evenly from all videos, within bounds for each class");
  command->footer(
      "Example: veldt balance my_dataset real --out chosen.json --per-class small_poacher=200:2000");
  auto options = std::make_shared<BalanceArguments>();
  command
      ->add_option("datasets", options->datasets, "Datasets, BIRDSAI folders or COCO files; never modified")
      ->required()
      ->type_name("DATASET…");
  command
      ->add_option("--per-class", options->per_class,
                   "Number of labels per class, e.g. 500:800 small_poacher=200:800.\n"
                   "Classes: small_animal, medium_animal, large_animal, small_poacher, medium_poacher,\n"
                   "large_poacher (or _human); classes that are not listed have no bounds.\n"
                   "Taking all labels of a class, where HI allows it, counts as perfectly even")
      ->required()
      ->type_name("[CLASS=]LO:HI …");
  command->add_option("--out", options->out, "The selection: a file that `veldt export --selection` reads")
      ->required()
      ->type_name("FILE");
  command->add_option("--seed", options->seed, "Random seed: which of several equivalent frames are selected")
      ->capture_default_str();
  command
      ->add_option("--gap", options->balance.gap,
                   "Largest accepted gap to the optimum, as a fraction of the objective")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--time-limit-s", options->balance.time_limit_s,
                   "Time limit, after which the best selection found so far is written")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the table as JSON");
  command->callback([options, &session] {
    session.run = [options, &session] { return run_balance(*options, session.common.quiet); };
  });
}

}  // namespace veldt
