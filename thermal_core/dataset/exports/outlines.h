#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/image.h"

namespace thermal {

/// A target's pixels, 1 of 0 and 1, in a frame of background around them.
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
/// OpenCV's findContours. A hole is joined to the outline around it by a cut of no width, there and back. Filled where
/// rays cross an odd number of edges, their union is the mask.
[[nodiscard]] std::vector<Outline> edge_outlines(const TargetMask& mask);

/// One outline for formats that have no more: its corners are within their pixels, 0.02 px from the edge. Rounded down to
/// whole pixels and drawn with its border, as cv::fillPoly does, it is the mask, holes too, if the mask has one part.
/// Other parts are joined to the largest by a line of one pixel width between the nearest corners, there and back; one
/// that is smaller than this line, or as small, is left out.
[[nodiscard]] Outline filled_outline(const TargetMask& mask);

/// One outline of polygons for formats that have no more, cut to their picture. Several are joined by lines of no width
/// between their nearest corners, there and back, in their order. Empty if nothing is inside the picture, and for several
/// polygons of more than 5000 corners in all, because the search compares all with all.
[[nodiscard]] Outline joined_outline(const std::vector<Outline>& polygons, int width_px, int height_px);

/// Intersection over union of a mask with outlines, filled where rays through centres of pixels cross an odd number of edges.
[[nodiscard]] double edge_iou(const TargetMask& mask, std::span<const Outline> outlines);

/// The same with what cv::fillPoly draws of an outline rounded down.
[[nodiscard]] double filled_iou(const TargetMask& mask, const Outline& outline);

}  // namespace thermal
