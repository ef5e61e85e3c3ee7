#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/json/file.h"
#include "labels/label_set.h"

namespace thermal {

/// Kind of bins.
enum class Bins {
  logarithmic,  ///< five per decade
  share,        ///< twenty from 0 to 1
  linear,       ///< about 25 of a round width
};

/// A label's value, if known, and its category.
struct HistogramValue {
  std::optional<double> value;
  std::size_t category = 0;
};

/// Edges (n + 1) of the bins that hold all values except half a percent at either end; {} without values.
[[nodiscard]] std::vector<double> bin_edges(std::vector<double> values, Bins bins);

/// A histogram as JSON: `known` (values) and `of` (labels); `least`, `median` and `most`; `edges` (n + 1); `counts`,
/// for each category n. Values beyond the edges count for the nearest bin, with their numbers in `below` and `above`.
/// Without values only `known` and `of`.
[[nodiscard]] Json histogram_of(const std::vector<HistogramValue>& values, std::size_t categories, Bins bins);

/// A report's figures on labels, as JSON: `sizes` of pictures, `categories` (names of those with labels, most labels
/// first), `videos` (images, labels, negatives, tracks … of each), `counts` (by category: of each size class,
/// ignored, truncated …), `histograms` (see histogram_of) and `heat` (see heat_of). Pure: the same labels give the
/// same document.
[[nodiscard]] Json label_figures(const LabelSet& set);

/// For each category of a set, its rank among those with labels, most labels first; ties by name. Categories without
/// any come last.
[[nodiscard]] std::vector<std::size_t> category_ranks(const LabelSet& set);

}  // namespace thermal
