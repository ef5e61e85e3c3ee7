#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/json_file.h"

namespace thermal {

/// How a quantity is divided.
enum class Bins {
  logarithmic,  ///< five to a factor of ten
  share,        ///< twenty from 0 to 1
  linear,       ///< about 25 of a round width
};

/// A label's value, if known, and which category it counts for.
struct HistogramValue {
  std::optional<double> value;
  std::size_t category = 0;
};

/// Edges (n + 1) of the bins that hold the values but for half a percent at either end; {} if there are no values.
[[nodiscard]] std::vector<double> bin_edges(std::vector<double> values, Bins bins);

/// `known` values `of` all; `least`, `median` and `most` of them; `edges` (n + 1); `counts`, for each category n of
/// them. Values beyond the edges count for the bin next to them, `below` and `above` say how many they are.
/// Without values only `known` and `of`.
[[nodiscard]] Json histogram_of(const std::vector<HistogramValue>& values, std::size_t categories, Bins bins);

}  // namespace thermal
