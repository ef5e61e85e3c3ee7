#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/compare/discrimination.h"
#include "analysis/compare/set_figures.h"

namespace thermal {

/// Some frames of a set.
using MeasuredFrames = std::vector<const FrameFigures*>;
/// Values by measure or feature; empty where unknown.
using KnownValues = std::vector<std::optional<double>>;

/// A figure of a set of frames.
struct Measure {
  std::string group;  ///< spectrum, grey levels, edges, noise, structure, targets
  std::string name;
  std::string unit;  ///< empty: none
};

/// All measures, in the order of values_of().
[[nodiscard]] const std::vector<Measure>& measures();

/// Values of the measures of some frames: power averaged over frames, then its logarithm; of edges' widths and of
/// targets, quantiles over all of them; of all others, the median over frames. Empty where unknown.
[[nodiscard]] KnownValues values_of(const MeasuredFrames& frames);

/// Names of the features by which a classifier separates frames, or crops of targets.
[[nodiscard]] const std::vector<std::string>& frame_features();
/// The same of crops of targets.
[[nodiscard]] const std::vector<std::string>& crop_features();

/// Features of frames; units are renumbered.
[[nodiscard]] FeatureTable frame_table(const MeasuredFrames& frames);
/// The same of all their crops; units without any are left out.
[[nodiscard]] FeatureTable crop_table(const MeasuredFrames& frames);

}  // namespace thermal
