#pragma once

#include <vector>

#include "base/image.h"

namespace thermal {

/// Most edges that are measured in a frame.
inline constexpr std::size_t kMostEdges = 12;

/// Distances over which the strongest straight edges of a frame rise from 10 to 90 % of their step, in pixels. Strongest:
/// of the steepest places of cells of 32 x 32 px, in falling order. Straight: over 9 px along the edge, gradients point
/// one way. An edge counts if both sides are level from 6 to 10 px off; widths above 7 px are
/// understated, because the sides are not level there yet. Empty where a frame has no such edge.
[[nodiscard]] std::vector<double> edge_widths_px(const Plane<float>& frame);

}  // namespace thermal
