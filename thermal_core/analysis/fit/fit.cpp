#include "analysis/fit/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <opencv2/core/optim.hpp>

#include "analysis/compare/measures.h"
#include "analysis/fit/fitted_keys.h"
#include "analysis/fit/stored_radiance.h"
#include "base/error.h"
#include "base/order_statistics.h"
#include "io/system/temporary.h"

namespace thermal {
namespace {

constexpr std::uint32_t kFitHalving = 200;  // draws of halvings that compare does not use
constexpr std::uint32_t kScaleHalving = 300;
constexpr int kFramesOfClip = 2;
constexpr double kUnlike = 0.65;  // area under the curve

MeasuredFrames figures_in(const std::vector<FrameFigures>& frames) {
  MeasuredFrames all;
  for (const FrameFigures& frame : frames) all.push_back(&frame);
  return all;
}

std::vector<FrameFigures> copies_of(const MeasuredFrames& frames) {
  std::vector<FrameFigures> copies;
  for (const FrameFigures* frame : frames) copies.push_back(*frame);
  return copies;
}

// --- distances

/// The known values of each feature of frames, then of targets.
std::vector<std::vector<double>> columns_of(const MeasuredFrames& frames) {
  std::vector<std::vector<double>> columns;
  for (const auto& [table, features] : {std::pair(frame_table(frames), frame_features().size()),
                                        std::pair(crop_table(frames), crop_features().size())}) {
    const std::size_t first = columns.size();
    columns.resize(first + features);
    for (const auto& row : table.rows) {
      for (std::size_t k = 0; k < features; ++k)
        if (row[k]) columns[first + k].push_back(*row[k]);
    }
  }
  return columns;
}

/// Quantiles from 5 to 95 %.
std::vector<double> quantiles_of(std::vector<double> values) {
  constexpr int kSteps = 20;
  std::ranges::sort(values);
  std::vector<double> quantiles;
  for (int k = 1; k < kSteps; ++k) {
    const double point = static_cast<double>(k) / kSteps * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(point);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    quantiles.push_back(values[below] +
                        (point - static_cast<double>(below)) * (values[above] - values[below]));
  }
  return quantiles;
}

/// Mean distance of the quantiles of two non-empty sets.
double distance_of(const std::vector<double>& one, const std::vector<double>& other) {
  const std::vector<double> first = quantiles_of(one);
  const std::vector<double> second = quantiles_of(other);
  double sum = 0;
  for (std::size_t k = 0; k < first.size(); ++k) sum += std::abs(first[k] - second[k]);
  return sum / static_cast<double>(first.size());
}

// --- the search

/// Calls a function with the coordinates of one stage, the others at their best values so far.
class StageTrials : public cv::MinProblemSolver::Function {
 public:
  StageTrials(const std::vector<std::size_t>& coordinates, std::vector<double> point,
              std::function<double(const std::vector<double>&)> cost)
      : coordinates_(coordinates), point_(std::move(point)), cost_(std::move(cost)) {}

  [[nodiscard]] int getDims() const override { return static_cast<int>(coordinates_.size()); }

  double calc(const double* values) const override {
    std::vector<double> point = point_;
    double outside = 0;
    for (std::size_t k = 0; k < coordinates_.size(); ++k) {
      point[coordinates_[k]] = std::clamp(values[k], 0.0, 1.0);
      outside += std::abs(values[k] - point[coordinates_[k]]);
    }
    return cost_(point) + outside;
  }

 private:
  const std::vector<std::size_t>& coordinates_;
  std::vector<double> point_;
  std::function<double(const std::vector<double>&)> cost_;
};

/// Minimises the cost: Nelder and Mead's simplex on one stage after the other, round by round with smaller steps.
/// Stages that clips may lack are tried with and without them first.
class SettingsSearch {
 public:
  SettingsSearch(const FittedSpace& space, int trials, std::function<double(const std::vector<double>&)> cost,
                 const RunHooks& hooks)
      : space_(space), trials_(trials), cost_(std::move(cost)), hooks_(hooks), best_(space.start()) {
    least_ = tried(best_);
  }

  void run() {
    constexpr std::array kSteps = {0.35, 0.15, 0.06};
    for (std::size_t round = 0; round < kSteps.size(); ++round) {
      const int end = trials_ * static_cast<int>(round + 1) / static_cast<int>(kSteps.size());
      std::size_t left = space_.size();
      for (const std::vector<std::size_t>& stage : space_.stages()) {
        const auto share = static_cast<double>(stage.size()) / static_cast<double>(left);
        if (round == 0) try_ends(stage);
        refine(stage, kSteps[round], static_cast<int>(share * (end - done_)));
        left -= stage.size();
      }
    }
  }

  [[nodiscard]] const std::vector<double>& best() const noexcept { return best_; }
  [[nodiscard]] double least() const noexcept { return least_; }
  [[nodiscard]] int done() const noexcept { return done_; }

 private:
  double tried(const std::vector<double>& point) {
    if (hooks_.stop_wanted()) throw Cancelled();
    const double cost = cost_(point);
    ++done_;
    hooks_.report({.clip = "settings", .done = done_, .total = std::max(trials_, done_)});
    if (done_ == 1 || cost < least_) {
      least_ = cost;
      best_ = point;
    }
    return cost;
  }

  void try_ends(const std::vector<std::size_t>& stage) {
    for (const std::size_t share : space_.shares()) {
      if (std::ranges::find(stage, share) == stage.end()) continue;
      for (const double end : {0.0, 1.0}) {
        std::vector<double> point = best_;
        point[share] = end;
        if (point != best_) tried(point);
      }
    }
  }

  void refine(const std::vector<std::size_t>& stage, double step, int trials) {
    constexpr double kSmallest = 1e-3;
    const auto dimensions = static_cast<int>(stage.size());
    if (trials <= dimensions + 1) return;
    const cv::Ptr<cv::MinProblemSolver::Function> function = cv::makePtr<StageTrials>(
        stage, best_, [this](const std::vector<double>& point) { return tried(point); });
    cv::Mat steps(dimensions, 1, CV_64F);
    cv::Mat point(1, dimensions, CV_64F);
    for (int k = 0; k < dimensions; ++k) {
      const double at = best_[stage[static_cast<std::size_t>(k)]];
      point.at<double>(k) = at;
      steps.at<double>(k) = at > 0.5 ? -step : step;
    }
    const auto solver = cv::DownhillSolver::create(
        function, steps, {cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, trials, kSmallest});
    solver->minimize(point);
  }

  const FittedSpace& space_;
  int trials_;
  std::function<double(const std::vector<double>&)> cost_;
  const RunHooks& hooks_;
  std::vector<double> best_;
  double least_ = 0;
  int done_ = 0;
};

// --- configs

/// A config with fewer clips, the first of each entry, and few frames.
Json with_few_clips(Json document, int most) {
  if (!document.contains("clips") || !document["clips"].is_array()) return document;
  double all = 0;
  const auto is_counted = [](const Json& entry) {
    return entry.is_object() && entry.contains("count") && entry["count"].is_number_integer();
  };
  for (const Json& entry : document["clips"]) all += is_counted(entry) ? entry["count"].get<double>() : 1;
  for (Json& entry : document["clips"]) {
    if (is_counted(entry)) {
      const double count = entry["count"].get<double>();
      entry["count"] =
          static_cast<int>(std::clamp(std::round(count * most / all), 1.0, std::max(1.0, count)));
    }
    if (entry.is_object() && entry.contains("frames") && entry["frames"].is_number_integer())
      entry["frames"] = std::min(entry["frames"].get<int>(), kFramesOfClip);
  }
  return document;
}

/// Config, plan and stored radiance of a document.
struct Footage {
  PlannedDataset planned;
  StoredRadiance radiance;
};

class Fitter {
 public:
  Fitter(const FitOptions& options, const PlanInto& plan)
      : options_(options), plan_(plan), document_(options.config) {}

  Fit run() {
    FrameSource source = read_frame_source(options_.real);
    targets_ = {.category = options_.real.category,
                .boxes = source.is_dataset ? options_.real.boxes : BoxStyle::drawn};
    const SetFigures real =
        measure_set(std::move(source), static_cast<std::size_t>(options_.most_frames), options_.show_real);
    const Halves halves = halves_of(real.frames, options_.seed, kFitHalving);
    const RealFeatures fitted(copies_of(halves.first), options_.seed);
    const std::vector<FrameFigures> judging = copies_of(halves.second);
    auto footage = footage_of("first");
    std::vector<FrameFigures> before = footage->radiance.measured(footage->planned.config.spec, targets_);
    Fit found;
    found.distance_before = fitted.distance(before);
    if (fit_size(fitted.frames(), before, *footage, found)) footage = footage_of("resized");
    const FittedSpace space(document_, footage->planned.config.document);
    const auto cost = [&](const std::vector<double>& point) {
      return fitted.distance(
          footage->radiance.measured(spec_of(space.document_at(point), *footage), targets_));
    };
    SettingsSearch search(space, options_.trials, cost, options_.trying);
    search.run();
    found.document = space.document_at(search.best());
    add_changes(space, search.best(), found);
    const std::vector<FrameFigures> after =
        footage->radiance.measured(spec_of(found.document, *footage), targets_);
    found.distance_after = search.least();
    found.trials = search.done();
    found.real_fitted = fitted.frames().size();
    found.real_judging = judging.size();
    found.made = after.size();
    judge(fitted.frames(), judging, before, after, found);
    return found;
  }

 private:
  [[nodiscard]] ResolvedConfig resolved(const Json& document) const {
    Json rooted = with_few_clips(document, options_.clips);
    root_files(rooted, std::filesystem::absolute(options_.config_name).parent_path());
    return resolve_config(std::move(rooted), options_.config_name, options_.assets);
  }

  [[nodiscard]] DatasetSpec spec_of(const Json& document, const Footage& footage) const {
    return with_flights_cut(resolved(document), footage.planned.plan, "plan").spec;
  }

  std::unique_ptr<Footage> footage_of(const std::string& name) {
    const Path folder = folder_.path() / name;
    const ResolvedConfig config = resolved(document_);
    check_can_be_exposed(config.spec, options_.config_name);
    PlannedDataset planned = plan_(folder, config);
    StoredRadiance radiance(planned, {folder, options_.assets}, static_cast<std::size_t>(options_.clips),
                            options_.assets, options_.rendering);
    return std::make_unique<Footage>(Footage{std::move(planned), std::move(radiance)});
  }

  /// Adjusts the focal length if targets are larger or smaller than real ones. Returns whether it did.
  bool fit_size(const std::vector<FrameFigures>& real, const std::vector<FrameFigures>& made,
                const Footage& footage, Fit& found) {
    constexpr std::size_t kLeastTargets = 20;
    constexpr double kRightSize = 0.06;  // of ln: about the scatter of the medians of a hundred people
    const auto heights = [](const std::vector<FrameFigures>& frames) {
      std::vector<double> all;
      for (const FrameFigures& frame : frames)
        for (const TargetCrop& crop : frame.crops) all.push_back(crop.box.height_px);
      return all;
    };
    const std::vector<double> of_real = heights(real);
    const std::vector<double> of_made = heights(made);
    if (std::min(of_real.size(), of_made.size()) < kLeastTargets) {
      found.no_size = fmt::format("{} real targets and {} made ones; {} of each are needed", of_real.size(),
                                  of_made.size(), kLeastTargets);
      return false;
    }
    const double ratio = median_of(of_real) / median_of(of_made);
    if (std::abs(std::log(ratio)) < kRightSize) return false;
    if (footage.planned.config.spec.settings->gives_intrinsics) {
      found.no_size = fmt::format(
          "targets are {:.2f} times as high, but the config gives the camera's intrinsics", ratio);
      return false;
    }
    const Json before = document_.value(Json::json_pointer("/camera/focal_length_m"), Json());
    const Json after = scaled(
        before.is_null() ? footage.planned.config.document["camera"]["focal_length_m"] : before, ratio);
    document_["camera"]["focal_length_m"] = after;
    found.changed.push_back({.key = "camera.focal_length_m", .before = before, .after = after});
    return true;
  }

  static Json scaled(const Json& value, double ratio) {
    if (value.is_number()) return rounded_to_three(value.get<double>() * ratio);
    Json all = value;
    if (all.is_object() || all.is_array())
      for (auto& [key, entry] : all.items())
        if (key != "weights") entry = scaled(entry, ratio);
    return all;
  }

  void add_changes(const FittedSpace& space, const std::vector<double>& point, Fit& found) const {
    for (std::size_t k = 0; k < fitted_keys().size(); ++k) {
      const FittedKey& key = fitted_keys()[k];
      const Json before = space.value_at(k, space.start());
      const Json after = space.value_at(k, point);
      if (before == after) continue;
      std::string name = std::string(key.path).substr(1);
      std::ranges::replace(name, '/', '.');
      found.changed.push_back(
          {.key = key.is_share ? name + ": share of clips" : name, .before = before, .after = after});
    }
  }

  void judge(const std::vector<FrameFigures>& fitted, const std::vector<FrameFigures>& judging,
             const std::vector<FrameFigures>& before, const std::vector<FrameFigures>& after,
             Fit& found) const {
    add_features(false, frame_table, frame_features(), fitted, judging, before, after, found);
    add_features(true, crop_table, crop_features(), fitted, judging, before, after, found);
    found.frames = forest_of(frame_table, frame_features().size(), judging, before, after);
    found.targets = forest_of(crop_table, crop_features().size(), judging, before, after);
  }

  using TableOf = FeatureTable (*)(const MeasuredFrames&);

  static void add_features(bool of_targets, TableOf table_of, const std::vector<std::string>& names,
                           const std::vector<FrameFigures>& fitted, const std::vector<FrameFigures>& judging,
                           const std::vector<FrameFigures>& before, const std::vector<FrameFigures>& after,
                           Fit& found) {
    const FeatureTable of_fitted = table_of(figures_in(fitted));
    const FeatureTable of_judging = table_of(figures_in(judging));
    const FeatureTable of_before = table_of(figures_in(before));
    const FeatureTable of_after = table_of(figures_in(after));
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto median = [k](const FeatureTable& table) -> std::optional<double> {
        std::vector<double> known = known_values(table, k);
        return known.empty() ? std::nullopt : std::optional(median_of(std::move(known)));
      };
      if (!median(of_judging) || !median(of_after)) continue;
      found.features.push_back({.name = names[k],
                                .of_targets = of_targets,
                                .real = median(of_judging),
                                .before = median(of_before),
                                .after = median(of_after),
                                .separation_before = separation_alone(of_judging, of_before, k),
                                .separation_after = separation_alone(of_judging, of_after, k),
                                .separation_of_halves = separation_alone(of_judging, of_fitted, k)});
    }
  }

  [[nodiscard]] FittedForest forest_of(TableOf table_of, std::size_t features,
                                       const std::vector<FrameFigures>& judging,
                                       const std::vector<FrameFigures>& before,
                                       const std::vector<FrameFigures>& after) const {
    const FeatureTable real = table_of(figures_in(judging));
    const auto classified = [&](const std::vector<FrameFigures>& frames) -> std::optional<Discrimination> {
      const FeatureTable table = table_of(figures_in(frames));
      if (!has_two_units(real) || !has_two_units(table)) return {};
      return discriminate(real, table, features, options_.seed);
    };
    return {.before = classified(before), .after = classified(after)};
  }

  const FitOptions& options_;
  const PlanInto& plan_;
  Json document_;
  TargetChoice targets_;
  TemporaryFolder folder_;
};

}  // namespace

void FitOptions::validate() const {
  const auto check = [](const char* option, int value, int least) {
    if (value < least)
      throw ConfigError(fault(option, std::to_string(value), "", fmt::format("at least {}", least)));
  };
  check("--clips", clips, 2);
  check("--frames", most_frames, 8);
  check("--trials", trials, 20);
}

bool FittedFeature::is_unlike() const {
  return separation_after > kUnlike && separation_after > separation_of_halves;
}

RealFeatures::RealFeatures(std::vector<FrameFigures> frames, std::uint32_t seed)
    : frames_(std::move(frames)), columns_(columns_of(figures_in(frames_))), scales_(columns_.size()) {
  constexpr std::uint32_t kScaleHalvings = 10;
  constexpr double kLeastShare = 0.01;
  std::vector<double> counts(columns_.size());
  for (std::uint32_t draw = 0; draw < kScaleHalvings; ++draw) {
    const Halves halves = halves_of(frames_, seed, kScaleHalving + draw);
    const auto first = columns_of(halves.first);
    const auto second = columns_of(halves.second);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (first[k].empty() || second[k].empty()) continue;
      scales_[k] += distance_of(first[k], second[k]);
      counts[k] += 1;
    }
  }
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (counts[k] > 0) scales_[k] /= counts[k];
    scales_[k] = std::max({scales_[k], kLeastShare * deviation_of(columns_[k]), 1e-3});
  }
}

double RealFeatures::distance(const std::vector<FrameFigures>& others) const {
  constexpr double kLacking = 100;
  const auto columns = columns_of(figures_in(others));
  double sum = 0;
  double count = 0;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (columns_[k].empty()) continue;
    count += 1;
    sum += std::log1p(columns[k].empty() ? kLacking : distance_of(columns_[k], columns[k]) / scales_[k]);
  }
  return count > 0 ? sum / count : 0;
}

Fit fit(const FitOptions& options, const PlanInto& plan) {
  options.validate();
  return Fitter(options, plan).run();
}

}  // namespace thermal
