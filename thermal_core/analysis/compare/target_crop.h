#pragma once

#include <optional>

#include "base/image.h"
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

}  // namespace thermal
