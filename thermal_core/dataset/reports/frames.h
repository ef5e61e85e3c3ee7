#pragma once

#include "io/json/file.h"
#include "labels/label_set.h"

namespace thermal {

/// A picture to show, and why.
struct SampleFrame {
  std::size_t image = 0;  ///< index into LabelSet::images
  std::string why;        ///< "most labels", "median", "no labels"
};

/// A deterministic choice of representative pictures: for each video the one with most labels, one with the median
/// number among those with labels, and one without; the first of equals. At most 18 in total: fewer per video for
/// many videos and, for more than 18, only some videos, evenly spaced.
[[nodiscard]] std::vector<SampleFrame> choose_samples(const LabelSet& set);

/// The pictures of samples as JPEGs in data URIs, with their boxes, as JSON. An unreadable picture is a DataError or
/// IoError if `all` is set; otherwise it is listed in `missing`.
[[nodiscard]] Json sample_figures(const LabelSet& set, bool all);

}  // namespace thermal
