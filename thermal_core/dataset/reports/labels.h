#pragma once

#include "io/json/file.h"
#include "labels/label_set.h"

namespace thermal {

/// A report's figures on labels, as JSON: `sizes` of pictures, `categories` (names of those with labels, most labels
/// first), `videos` (images, labels, negatives, tracks … of each), `counts` (by category: of each size class,
/// ignored, truncated …), `histograms` (see histogram_of) and `heat` (see heat_of). Pure: the same labels give the
/// same document.
[[nodiscard]] Json label_figures(const LabelSet& set);

/// For each category of a set, its rank among those with labels, most labels first; ties by name. Categories without
/// any come last.
[[nodiscard]] std::vector<std::size_t> category_ranks(const LabelSet& set);

}  // namespace thermal
