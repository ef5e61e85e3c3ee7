#pragma once

#include "io/json_file.h"
#include "labels/label_set.h"

namespace thermal {

/// A picture to show, and what it stands for.
struct SampleFrame {
  std::size_t image = 0;  ///< place in LabelSet::images
  std::string why;        ///< "most labels", "median", "no labels"
};

/// Pictures that stand for a set, always the same ones: of each video the one with most labels, one with the median
/// number of those with labels, one without; the first of equals. At most 18 in all: of many videos fewer, and of more
/// than 18 only of some, evenly spread.
[[nodiscard]] std::vector<SampleFrame> choose_samples(const LabelSet& set);

/// The pictures of samples as JPEGs in data URIs, with their boxes, as JSON. A picture that can't be read is a DataError
/// or IoError where `all` is set, and else left out, and told of in `missing`.
[[nodiscard]] Json sample_figures(const LabelSet& set, bool all);

}  // namespace thermal
