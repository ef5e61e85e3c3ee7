#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/compare/comparison.h"
#include "analysis/compare/frame_source.h"
#include "dataset/plan/dataset_plan.h"
#include "dataset/progress.h"
#include "io/assets.h"
#include "io/config/config.h"

namespace thermal {

/// Options of a fit.
struct FitOptions {
  Assets assets;
  FrameRequest real = {};
  Json config = {};              ///< document, not resolved; paths are relative to its own folder
  std::string config_name = {};  ///< for messages, and of that folder
  int clips = 18;                ///< of the config, two frames of each
  int most_frames = 200;         ///< of the real ones
  int trials = 300;              ///< number of settings that are tried
  std::uint32_t seed = 1;
  std::function<void(std::size_t done, std::size_t total)> show_real = {};  ///< called as frames are measured
  RunHooks rendering = {};                                                  ///< of frames
  RunHooks trying = {};                                                     ///< of trials

  /// ConfigError unless there are 2 clips, 8 frames and 20 trials at least.
  void validate() const;
};

/// Plans a config into a folder.
using PlanInto = std::function<PlannedDataset(const Path& folder, const ResolvedConfig& config)>;

/// A feature of frames or targets: medians, and how well it alone separates frames from the held-out half of the real
/// ones (area under the curve, .5 or more).
struct FittedFeature {
  std::string name;
  bool of_targets = false;
  std::optional<double> real;
  std::optional<double> before;
  std::optional<double> after;
  double separation_before = 0.5;
  double separation_after = 0.5;
  double separation_of_halves = 0.5;  ///< separation of the fitted half from the held-out one

  /// Whether it separates by more than a threshold, and more than it separates the real halves.
  [[nodiscard]] bool is_unlike() const;
};

/// Separation by the classifier of frames or targets, before and after; empty: too few clips or targets.
struct FittedForest {
  std::optional<Discrimination> before;
  std::optional<Discrimination> after;
};

/// A key that the fit changed.
struct ChangedKey {
  std::string key;  ///< "sensor.noise.amount"
  Json before;      ///< null: the config had none
  Json after;
};

/// The fitted config: its frames resemble the real ones most.
struct Fit {
  Json document;  ///< as given, with the fitted keys
  std::vector<ChangedKey> changed;
  std::vector<FittedFeature> features;
  FittedForest frames;
  FittedForest targets;
  double distance_before = 0;  ///< from the fitted half of the real frames; see RealFeatures
  double distance_after = 0;
  std::size_t real_fitted = 0;  ///< frames
  std::size_t real_judging = 0;
  std::size_t made = 0;
  int trials = 0;
  std::string no_size;  ///< why the size of targets was not fitted; empty: fitted, or already right
};

/// Fits the sensor, the link, the codec and, if both sets have targets, the focal length of a config to real frames.
/// One half of them, by units, is fitted, the other is held out to judge. The result depends on the frames, the config
/// and the options alone. ConfigError as check_can_be_exposed(); faults of read_frame_source() and measure_set().
[[nodiscard]] Fit fit(const FitOptions& options, const PlanInto& plan);

/// Features of some real frames, and the distance of others from them.
class RealFeatures {
 public:
  /// @param frames  of at least two units
  RealFeatures(std::vector<FrameFigures> frames, std::uint32_t seed);

  /// Mean over the known features of ln(1 + d / h): d is the mean distance of quantiles (5 to 95 %), h the same of
  /// random halves of the real frames, at least a hundredth of their deviation. A feature that the others lack counts
  /// as 100 h.
  [[nodiscard]] double distance(const std::vector<FrameFigures>& others) const;

  [[nodiscard]] const std::vector<FrameFigures>& frames() const noexcept { return frames_; }

 private:
  std::vector<FrameFigures> frames_;
  std::vector<std::vector<double>> columns_;  ///< by feature, of frames and then of targets
  std::vector<double> scales_;
};

}  // namespace thermal
