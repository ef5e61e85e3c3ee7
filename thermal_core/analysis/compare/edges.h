#pragma once

#include <vector>

#include "base/image.h"

namespace thermal {

/// Most edges that are measured in a frame.
inline constexpr std::size_t kMostEdges = 12;

/// Profile of a straight edge. Halos are the traces of an unsharp mask, up to 6 px from the edge.
struct Edge {
  double width_px = 0;  ///< over which it rises from 10 to 90 % of its step; above 7 px understated
  double undershoot =
      0;  ///< how far the lower side falls below its level before the edge, as a share of the step
  double overshoot = 0;  ///< how far the higher side exceeds its level after it
};

/// The strongest straight edges of a frame. Strongest:
/// of the steepest places of cells of 32 x 32 px, in falling order. Straight: gradients are parallel over 9 px along
/// the edge. Both sides must be level from 6 to 10 px off; widths of wide edges are understated, because their sides
/// are not level there yet. Levels are means over 9 px along the edge and half a pixel across; their residual noise
/// adds to halos. Empty where a frame has no such edge.
[[nodiscard]] std::vector<Edge> straight_edges(const Plane<float>& frame);

}  // namespace thermal
