#pragma once

#include <array>
#include <cstddef>

#include "io/system/files.h"
#include "labels/box_style.h"

namespace thermal {

/// Boxes of a kind, and in how many of them the target could be measured.
struct MeasuredBoxes {
  std::size_t boxes = 0;
  std::size_t measured = 0;
};

/// How annotators drew the boxes of a set.
struct MeasuredFills {
  DrawnFills fills;
  std::array<MeasuredBoxes, 3> kinds;  ///< by Kind
};

/// Measures which shares of drawn boxes the targets in them fill: for each kind, the medians over the boxes whose
/// target target_crop() finds, and which differ from their surroundings by at least 4 of the surroundings' deviations;
/// a fainter target merges with warm surroundings. A kind with fewer than 20 such boxes has the medians of all. Of at
/// most 1000 pictures with boxes, evenly spaced; without crowds and ignored boxes.
/// @param labels  as read_labels() accepts it
/// @param frames  folder of the pictures; empty: that of the labels
/// DataError if fewer than 20 boxes can be measured, for a missing picture, and those of read_labels() and
/// read_grey_picture().
[[nodiscard]] MeasuredFills measure_drawn_fills(const Path& labels, const Path& frames);

}  // namespace thermal
