#include "analysis/balance/balance.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "analysis/balance/selection.h"
#include "base/error.h"
#include "base/text.h"
#include "cli/command.h"
#include "cli/output.h"
#include "dataset/label_source.h"

namespace veldt {
namespace {

using thermal::ClassBounds;
using thermal::ConfigError;

constexpr std::int64_t kMostLabels = 1'000'000'000;  // of a class; far more than any data set has

ConfigError fault_of(const std::string& word, const std::string& rule) {
  return ConfigError(thermal::fault("--per-class", "\"" + word + "\"", "", rule));
}

std::optional<std::int64_t> parse_count(std::string_view text) {
  const auto count = thermal::number_in<std::int64_t>(text);
  return count && *count >= 0 && *count <= kMostLabels ? count : std::nullopt;
}

/// "LO:HI"; `word` is the argument that contains it, for messages.
ClassBounds parse_bounds(std::string_view text, const std::string& word) {
  const std::size_t colon = text.find(':');
  const auto low = parse_count(text.substr(0, colon));
  const auto high = parse_count(colon == std::string_view::npos ? "" : text.substr(colon + 1));
  if (!low || !high)
    throw fault_of(word, "LO:HI or CLASS=LO:HI, whole numbers from 0 to " + std::to_string(kMostLabels));
  if (*low > *high) throw fault_of(word, "LO:HI with LO at most HI");
  return {.at_least = *low, .at_most = *high};
}

/// The category of poachers is `human`, so small_human is an alias of small_poacher.
std::string with_poachers(const std::string& name) {
  const std::size_t size = name.rfind("_human");
  return size != std::string::npos && name.ends_with("_human") ? name.substr(0, size) + "_poacher" : name;
}

std::size_t parse_class(const std::string& name, const std::string& word) {
  const auto& names = thermal::balance_class_names();
  const std::string known = with_poachers(name);
  const auto found = std::find(names.begin(), names.end(), known);
  if (found == names.end())
    throw fault_of(word,
                   "one of " + thermal::list_names(names) + " before =" + thermal::did_you_mean(name, names));
  return static_cast<std::size_t>(found - names.begin());
}

/// Bounds from --per-class: "LO:HI" for all classes, "small_animal=LO:HI" for one, which takes precedence. Classes that
/// are not listed have no bounds. ConfigError for anything else.
std::array<ClassBounds, thermal::kBalanceClasses> parse_class_bounds(const std::vector<std::string>& words) {
  std::array<std::optional<ClassBounds>, thermal::kBalanceClasses> given;
  std::optional<ClassBounds> others;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const bool for_one = equals != std::string::npos;
    auto& place = for_one ? given[parse_class(word.substr(0, equals), word)] : others;
    if (place) throw fault_of(word, for_one ? "each class once" : "one LO:HI for all classes");
    place = parse_bounds(std::string_view(word).substr(for_one ? equals + 1 : 0), word);
  }
  std::array<ClassBounds, thermal::kBalanceClasses> bounds;
  for (std::size_t k = 0; k < bounds.size(); ++k)
    bounds[k] = given[k].value_or(others.value_or(ClassBounds{.at_least = 0, .at_most = kMostLabels}));
  return bounds;
}

/// Result of `balance`.
struct Balanced {
  std::vector<thermal::LabelSource> sources;
  thermal::BalanceProgram program;
  thermal::BalanceResult result;
  thermal::Selection selection;
  double time_s = 0;
};

using thermal::ClassCounts;
using thermal::kBalanceClasses;

/// A line of the table: a video, or all of them.
struct Row {
  std::string dataset;
  std::string video;
  std::size_t frames_taken = 0;
  std::size_t frames = 0;
  std::size_t unlabelled = 0;
  ClassCounts taken{};
  ClassCounts available{};

  void add(const Row& other) {
    frames_taken += other.frames_taken;
    frames += other.frames;
    unlabelled += other.unlabelled;
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      taken[k] += other.taken[k];
      available[k] += other.available[k];
    }
  }
};

std::vector<Row> rows_of(const Balanced& balanced) {
  std::vector<Row> rows;
  for (const thermal::SelectedDataset& dataset : balanced.selection.datasets) {
    for (const thermal::SelectedVideo& selected : dataset.videos) {
      const std::size_t i = rows.size();
      const thermal::BalanceVideo& video = balanced.program.videos[i];
      Row row{.dataset = dataset.path,
              .video = selected.name,
              .frames_taken = selected.frames.size(),
              .frames = video.unlabelled,
              .unlabelled = video.unlabelled,
              .taken = balanced.result.solution.labels_of(balanced.program, i),
              .available = video.available()};
      for (const thermal::FrameType& type : video.types) row.frames += type.frames.size();
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

Row sum_of(const std::vector<Row>& rows) {
  Row all{.dataset = "", .video = "all"};
  for (const Row& row : rows) all.add(row);
  return all;
}

std::string share(std::int64_t taken, std::int64_t available) {
  return available == 0 ? "-" : fmt::format("{}/{}", taken, available);
}

std::string head_of(std::size_t k) {
  std::string name = thermal::balance_class_names()[k];
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Cells of a row after its name.
std::vector<std::string> cells_of(const Row& row) {
  std::vector<std::string> cells = {fmt::format("{}/{}", row.frames_taken, row.frames)};
  for (std::size_t k = 0; k < kBalanceClasses; ++k) cells.push_back(share(row.taken[k], row.available[k]));
  return cells;
}

/// Columns under their headings, as wide as needed; names left-aligned, numbers right-aligned.
void print_rows(const std::vector<std::pair<std::string, std::vector<std::string>>>& lines) {
  std::vector<std::size_t> widths(kBalanceClasses + 1, 0);
  std::size_t name_width = 0;
  for (const auto& [name, cells] : lines) {
    name_width = std::max(name_width, name.size());
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  }
  for (const auto& [name, cells] : lines) {
    print("{:<{}}", name, name_width);
    for (std::size_t i = 0; i < cells.size(); ++i) print("  {:>{}}", cells[i], widths[i]);
    print("\n");
  }
}

std::vector<std::string> headings() {
  std::vector<std::string> cells = {"frames"};
  for (std::size_t k = 0; k < kBalanceClasses; ++k) cells.push_back(head_of(k));
  return cells;
}

thermal::Json counts_json(const ClassCounts& counts) {
  thermal::Json json = thermal::Json::object();
  for (std::size_t k = 0; k < kBalanceClasses; ++k) json[thermal::balance_class_names()[k]] = counts[k];
  return json;
}

thermal::Json row_json(const Row& row) {
  return {{"frames_taken", row.frames_taken},
          {"frames", row.frames},
          {"unlabelled_frames", row.unlabelled},
          {"taken", counts_json(row.taken)},
          {"available", counts_json(row.available)}};
}

thermal::Json bounds_json(const thermal::BalanceProgram& program) {
  thermal::Json json = thermal::Json::object();
  for (std::size_t k = 0; k < kBalanceClasses; ++k)
    json[thermal::balance_class_names()[k]] = {{"at_least", program.bounds[k].at_least},
                                               {"at_most", program.bounds[k].at_most}};
  return json;
}

/// Prints selected and available labels by video and class, and the quality of the selection.
void print_table(const Balanced& balanced) {
  const std::vector<Row> rows = rows_of(balanced);
  const Row all = sum_of(rows);
  std::vector<std::pair<std::string, std::vector<std::string>>> lines = {{"taken/all", headings()}};
  for (const Row& row : rows) {
    const bool several = balanced.sources.size() > 1;
    lines.emplace_back(several ? row.dataset + ": " + row.video : row.video, cells_of(row));
  }
  lines.emplace_back("all", cells_of(all));
  print_rows(lines);
  const thermal::BalanceResult& result = balanced.result;
  print(
      "objective: {} (most labels from one video minus fewest from a video with labels left, summed over "
      "classes)\n",
      result.solution.objective);
  print("lower bound: {}, gap {:.2f} %, {:.1f} s\n", result.bound, 100 * result.gap, balanced.time_s);
  if (all.frames_taken == 0) print("no frame is selected: no class requires a label\n");
  if (all.unlabelled > 0)
    print("{} frames have no label that counts; none of them is selected\n", all.unlabelled);
}

/// The same as JSON.
thermal::Json to_json(const Balanced& balanced) {
  const std::vector<Row> rows = rows_of(balanced);
  thermal::Json videos = thermal::Json::array();
  for (const Row& row : rows) {
    thermal::Json video = {{"dataset", row.dataset}, {"video", row.video}};
    video.update(row_json(row));
    videos.push_back(std::move(video));
  }
  return {{"objective", balanced.result.solution.objective},
          {"bound", balanced.result.bound},
          {"gap", balanced.result.gap},
          {"in_time", balanced.result.in_time},
          {"time_s", balanced.time_s},
          {"per_class", bounds_json(balanced.program)},
          {"most_from_a_video", counts_json(balanced.result.solution.most)},
          {"least_from_a_video", counts_json(balanced.result.solution.least)},
          {"all", row_json(sum_of(rows))},
          {"videos", std::move(videos)}};
}

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

void add_balance(Parser& parser) {
  Command command =
      parser.add_command("balance",
                         "Select frames so that small, medium and large animals and poachers are drawn\n"
                         "evenly from all videos, within bounds for each class");
  command.footer(
      "Example: veldt balance my_dataset real --out chosen.json --per-class small_poacher=200:2000");
  auto options = std::make_shared<BalanceArguments>();
  command.add_option("datasets", options->datasets, "Datasets, BIRDSAI folders or COCO files; never modified")
      .required()
      .type_name("DATASET…");
  command
      .add_option("--per-class", options->per_class,
                  "Number of labels per class, e.g. 500:800 small_poacher=200:800.\n"
                  "Classes: small_animal, medium_animal, large_animal, small_poacher, medium_poacher,\n"
                  "large_poacher (or _human); classes that are not listed have no bounds.\n"
                  "Taking all labels of a class, where HI allows it, counts as perfectly even")
      .required()
      .type_name("[CLASS=]LO:HI …");
  command.add_option("--out", options->out, "The selection: a file that `veldt export --selection` reads")
      .required()
      .type_name("FILE");
  command.add_option("--seed", options->seed, "Random seed: which of several equivalent frames are selected")
      .shows_default();
  command
      .add_option("--gap", options->balance.gap,
                  "Largest accepted gap to the optimum, as a fraction of the objective")
      .between(0.0, 1.0)
      .shows_default();
  command
      .add_option("--time-limit-s", options->balance.time_limit_s,
                  "Time limit, after which the best selection found so far is written")
      .between(0.001, 1e6)
      .shows_default();
  command.add_flag("--json", options->json, "Print the table as JSON");
  command.runs([options](const CommonOptions& common) { return run_balance(*options, common.quiet); });
}

}  // namespace veldt
