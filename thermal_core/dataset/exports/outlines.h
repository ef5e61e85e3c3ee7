#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/image.h"

namespace thermal {

/// A target's mask, 0 or 1, with a border of background.
struct TargetMask {
  int left_px = 0;  ///< of the plane's first column in the picture
  int top_px = 0;
  Plane<std::uint8_t> pixels;
};

/// A corner of an outline: the top left corner of the top left pixel is (0, 0).
struct OutlinePoint {
  double x_px = 0;
  double y_px = 0;

  [[nodiscard]] bool operator==(const OutlinePoint&) const = default;
};

using Outline = std::vector<OutlinePoint>;  ///< closed: the last point is joined to the first

/// Outlines along the edges of pixels, one for each part of a mask (pixels that touch at a corner are one part), by
/// OpenCV's findContours. A hole is joined to the outline around it by a zero-width bridge. Filled by the even-odd
/// rule, their union is the mask.
[[nodiscard]] std::vector<Outline> edge_outlines(const TargetMask& mask);

/// A single outline for formats that allow no more: its corners are within their pixels, 0.02 px from the edge. Rounded
/// down to whole pixels and drawn with its border, as cv::fillPoly does, it reproduces a mask of one part exactly, with
/// holes. Other parts are joined to the largest by a bridge of one pixel width between the nearest corners; parts no
/// larger than their bridge are left out.
[[nodiscard]] Outline filled_outline(const TargetMask& mask);

/// A single outline of polygons for formats that allow no more, clipped to their picture. Several are joined in order
/// by zero-width bridges between their nearest corners. Empty if nothing is inside the picture, and for several
/// polygons of more than 5000 corners in all, because the search is quadratic.
[[nodiscard]] Outline joined_outline(const std::vector<Outline>& polygons, int width_px, int height_px);

/// Intersection over union of a mask with outlines, filled by the even-odd rule at centres of pixels.
[[nodiscard]] double edge_iou(const TargetMask& mask, std::span<const Outline> outlines);

/// The same with cv::fillPoly's drawing of an outline rounded down.
[[nodiscard]] double filled_iou(const TargetMask& mask, const Outline& outline);

}  // namespace thermal
