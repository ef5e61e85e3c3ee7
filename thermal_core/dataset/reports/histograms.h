#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/json/file.h"

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

}  // namespace thermal
