#include "analysis/fit/fit.h"

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/planning.h"
#include "cli/progress_bar.h"
#include "dataset/plan/plan_store.h"
#include "io/assets.h"

namespace veldt {
namespace {

struct FitArguments {
  std::string real;
  std::string config;
  std::string out;
  std::string real_labels;
  std::string category;
  thermal::FitOptions request{.assets = thermal::Assets(thermal::Path())};
  std::vector<std::string> settings;
  bool json = false;
};

void check_fit_out(const std::string& file) {
  const thermal::Path out = file;
  if (!out.parent_path().empty() && !std::filesystem::is_directory(out.parent_path()))
    throw thermal::ConfigError(thermal::fault("--out", file, "", "a file in an existing folder"));
}

/// Reads the config with its settings; paths in it are made valid for the output's folder.
thermal::Json read_fitted_config(const FitArguments& options) {
  thermal::Json document = read_named_document(options.config);
  for (const std::string& setting : options.settings) thermal::apply_setting(document, setting);
  const auto folder_of = [](const std::string& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path());
  };
  if (folder_of(options.config) == folder_of(options.out)) return document;
  thermal::root_files(document, folder_of(options.config));
  document.erase("$schema");
  return document;
}

thermal::Fit fitted(const FitArguments& options, const CommonOptions& common) {
  thermal::FitOptions request = options.request;
  request.real = {.source = options.real, .labels = options.real_labels, .category = options.category};
  request.config = read_fitted_config(options);
  request.config_name = options.config;
  request.assets = thermal::Assets::find();
  const auto plan = [&](const thermal::Path& folder, const thermal::ResolvedConfig& config) {
    thermal::PlannedDataset planned;
    plan_with_progress(common, request.assets, [&](const thermal::PlanOptions& planning) {
      planned = thermal::PlanStore(folder, request.assets).plan(config, options.config, planning);
    });
    return planned;
  };
  watch_for_stop();
  ProgressBar measuring(common, "starting", "frames", kClipPatience);
  ProgressBar rendering(common, "building the scene", "frames", kClipPatience);
  ProgressBar trying(common, "trying settings", "trials", kClipPatience);
  const thermal::RunHooks measured = hooks_for(measuring);
  request.show_real = [&measured](std::size_t done, std::size_t total) {
    measured.progress(
        {.clip = "real frames", .done = static_cast<int>(done), .total = static_cast<int>(total)});
  };
  request.rendering = hooks_for(rendering);
  request.trying = hooks_for(trying);
  return thermal::fit(request, plan);
}

// --- output

std::string median_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : "-";
}

/// A number, "1.2 to 3", or "-".
std::string value_text(const thermal::Json& value) {
  if (value.is_number()) return fmt::format("{:.3g}", value.get<double>());
  if (value.is_object() && value.contains("uniform"))
    return fmt::format("{} to {}", value_text(value["uniform"][0]), value_text(value["uniform"][1]));
  return value.is_null() ? "-" : thermal::brief(value);
}

void print_features(const thermal::Fit& fit, bool of_targets) {
  for (const thermal::FittedFeature& one : fit.features) {
    if (one.of_targets != of_targets) continue;
    print("  {:<36} {:>8} {:>8} {:>8} {:>7.2f} {:>6.2f} {:>6.2f}{}\n", one.name, median_text(one.real),
          median_text(one.before), median_text(one.after), one.separation_before, one.separation_after,
          one.separation_of_halves, one.is_unlike() ? "  !" : "");
  }
}

void print_forest(const char* what, const thermal::FittedForest& forest) {
  if (!forest.before || !forest.after) return;
  print("classifier of {}: AUC {:.3f} before, {:.3f} after\n", what, forest.before->auc, forest.after->auc);
}

void print_fit(const thermal::Fit& fit) {
  print("{} trials; {} real frames fitted with {} made ones, {} held out\n", fit.trials, fit.real_fitted,
        fit.made, fit.real_judging);
  print("distance from the frames that were fitted: {:.3f} before, {:.3f} after\n", fit.distance_before,
        fit.distance_after);
  print("\n{:<46} {:>16} {:>16}\n", "changed", "before", "after");
  for (const thermal::ChangedKey& one : fit.changed)
    print("  {:<44} {:>16} {:>16}\n", one.key, value_text(one.before), value_text(one.after));
  print("\n{:<38} {:>26} {:>21}\n", "", "medians", "AUC");
  print("{:<38} {:>8} {:>8} {:>8} {:>7} {:>6} {:>6}\n", "frames", "real", "before", "after", "before",
        "after", "halves");
  print_features(fit, false);
  if (fit.targets.after) print("targets\n");
  print_features(fit, true);
  print_forest("frames", fit.frames);
  print_forest("targets", fit.targets);
  if (std::ranges::any_of(fit.features, &thermal::FittedFeature::is_unlike))
    print("! could not be fitted: AUC above .65, and above that of halves of the real frames\n");
  if (!fit.no_size.empty()) print("the size of targets was not fitted: {}\n", fit.no_size);
}

thermal::Json fit_json(const thermal::Fit& fit) {
  const auto known = [](const std::optional<double>& value) {
    return value ? thermal::Json(*value) : thermal::Json();
  };
  thermal::Json changed = thermal::Json::array();
  for (const thermal::ChangedKey& one : fit.changed)
    changed.push_back({{"key", one.key}, {"before", one.before}, {"after", one.after}});
  thermal::Json features = thermal::Json::array();
  for (const thermal::FittedFeature& one : fit.features) {
    features.push_back({{"feature", one.name},
                        {"of", one.of_targets ? "targets" : "frames"},
                        {"real", known(one.real)},
                        {"before", known(one.before)},
                        {"after", known(one.after)},
                        {"auc_before", one.separation_before},
                        {"auc_after", one.separation_after},
                        {"auc_halves", one.separation_of_halves},
                        {"fitted", !one.is_unlike()}});
  }
  const auto forest = [](const thermal::FittedForest& one) -> thermal::Json {
    if (!one.before || !one.after) return {};
    return {{"before", one.before->auc}, {"after", one.after->auc}};
  };
  return {{"format", "veldt-fit"},
          {"version", 1},
          {"trials", fit.trials},
          {"real_fitted", fit.real_fitted},
          {"real_judging", fit.real_judging},
          {"made", fit.made},
          {"distance_before", fit.distance_before},
          {"distance_after", fit.distance_after},
          {"changed", std::move(changed)},
          {"features", std::move(features)},
          {"frames_told_apart", forest(fit.frames)},
          {"targets_told_apart", forest(fit.targets)},
          {"no_size", fit.no_size.empty() ? thermal::Json() : thermal::Json(fit.no_size)}};
}

int run_fit(const FitArguments& options, const CommonOptions& common) {
  check_fit_out(options.out);
  const thermal::Fit fit = fitted(options, common);
  thermal::write_file_atomically(options.out, thermal::to_text(fit.document));
  if (options.json) {
    print_json(fit_json(fit));
  } else if (!common.quiet) {
    print_fit(fit);
    print("{}: written; veldt generate {} --out DIR makes such frames\n", options.out, options.out);
  }
  return kDone;
}

}  // namespace

void add_fit(Parser& parser) {
  Command command = parser.add_command(
      "fit", "Fit a config's gain, optics, noise, sharpening, link, codec and lens to real frames");
  command.footer(
      "A few clips of the config are rendered once, then exposed with other settings in each trial, until\n"
      "the measures of `veldt compare` differ from those of the real frames as little as may be. Half of\n"
      "the real frames are fitted, the others are held out: a table says how well each measure alone, and\n"
      "a classifier, separate them from made frames before and after. The size of targets, by the lens,\n"
      "needs labels; all else does not.\n"
      "Example: veldt fit real_frames --config my.json --out fitted.json");
  auto options = std::make_shared<FitArguments>();
  command.add_option("real", options->real, "Real frames: a folder of grey pictures, or a Veldt dataset")
      .required();
  command.add_option("--config", options->config, "Config to begin with, JSON").required().type_name("FILE");
  command.add_option("--out", options->out, "The config with what was fitted").required().type_name("FILE");
  command
      .add_option(
          "--real-labels", options->real_labels,
          "COCO labels of a folder of real frames; by default annotations.json in it or in its parent")
      .type_name("FILE");
  command.add_option("--category", options->category, "Category of the targets (default: people)")
      .type_name("NAME");
  command.add_option("--clips", options->request.clips, "Most clips of the config, two frames of each")
      .shows_default();
  command.add_option("--frames", options->request.most_frames, "Most real frames, evenly spaced")
      .shows_default();
  command.add_option("--trials", options->request.trials, "How many settings to try").shows_default();
  command.add_option("--seed", options->request.seed, "Which real frames are held out").shows_default();
  add_settings(command, options->settings);
  command.add_flag("--json", options->json, "Print JSON");
  command.runs([options](const CommonOptions& common) { return run_fit(*options, common); });
}

}  // namespace veldt
