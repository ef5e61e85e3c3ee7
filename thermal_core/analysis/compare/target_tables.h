#pragma once

#include <cstddef>
#include <vector>

#include "analysis/compare/set_figures.h"

namespace thermal {

/// Medians over the targets seen from a band of heights.
struct AltitudeRow {
  double from_m = 0;
  double to_m = 0;  ///< excluded
  std::size_t targets = 0;
  double width_px = 0;
  double height_px = 0;
  double contrast = 0;
  double ring_deviation = 0;
};

/// Bands of 20 m around 20, 40, 60 … m that have targets; empty without known heights.
[[nodiscard]] std::vector<AltitudeRow> targets_by_altitude(const SetFigures& set);

/// Of one figure of targets.
struct MeanAndDeviation {
  double mean = 0;
  double deviation = 0;
};

/// Margins of boxes round warm blobs: see BoxMargins.
struct MarginRow {
  double from_px = 0;
  double to_px = 0;  ///< excluded; 0: no limit
  std::size_t targets = 0;
  MeanAndDeviation left_px;
  MeanAndDeviation right_px;
  MeanAndDeviation top_px;
  MeanAndDeviation bottom_px;
};

/// Size by which targets are grouped: the longer side of the blob, or of the box.
enum class MarginsBy { blob, box };

/// Non-empty rows, from 0, 6, 9, 12, 16, 20, 26 and 40 px up.
[[nodiscard]] std::vector<MarginRow> margins_by_size(const SetFigures& set, MarginsBy by);

/// Targets of all frames, those with known margins, and labelled boxes too small to be targets.
struct TargetCounts {
  std::size_t boxes = 0;
  std::size_t targets = 0;
  std::size_t with_margins = 0;
};
/// Counts of a set's targets.
[[nodiscard]] TargetCounts target_counts(const SetFigures& set);

}  // namespace thermal
