#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/image.h"
#include "io/system/files.h"
#include "labels/box_style.h"
#include "labels/label_set.h"

namespace thermal {

/// Width of the ring around a box that represents the surroundings.
inline constexpr int kRingPx = 6;

/// How far a box reaches beyond the warm blob in it, by side, in pixels; negative where the blob reaches farther.
struct BoxMargins {
  double left_px = 0;
  double right_px = 0;
  double top_px = 0;
  double bottom_px = 0;
  double blob_width_px = 0;
  double blob_height_px = 0;
};

/// Appearance of a target in its box; levels of 0 to 255.
struct TargetCrop {
  LabelBox box;
  double contrast = 0;           ///< 95th percentile within the box minus the ring's mean
  double ring_deviation = 0;     ///< texture of the surroundings
  double gradient_variance = 0;  ///< of the gradients' magnitude within the box, levels a pixel squared
  double entropy_bits = 0;       ///< of the levels within the box, in 32 bins of 8
  double white_share = 0;        ///< share of the pixels within the box with level 252 or more
  std::optional<BoxMargins> margins = {};
};

/// Measures a target. Margins are those of the largest connected blob in the box that exceeds the ring's mean by half
/// the contrast. They are unknown where the contrast is below three deviations of the ring, and where the blob reaches
/// the ring's outer border, because it merges with another warm object. Empty for a box of which less than 3 x 3 px are
/// in the frame, or that fills it.
[[nodiscard]] std::optional<TargetCrop> target_crop(const Plane<float>& frame, const LabelBox& box);

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
