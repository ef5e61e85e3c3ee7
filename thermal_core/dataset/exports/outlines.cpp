#include "dataset/exports/outlines.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace thermal {
namespace {

/// Contour of a mask enlarged twice: pixel x has the columns 2 x and 2 x + 1, so that contours turn at corners of
/// pixels, and not at their centres.
using Ring = std::vector<cv::Point>;

/// A connected part of a mask: its outer contour, with holes joined to it, and its number of pixels.
struct Part {
  Ring ring;
  int area_px = 0;
};

cv::Mat enlarged(const TargetMask& mask) {
  cv::Mat large(2 * mask.pixels.height_px(), 2 * mask.pixels.width_px(), CV_8U);
  for (int y = 0; y < large.rows; ++y)
    for (int x = 0; x < large.cols; ++x) large.at<std::uint8_t>(y, x) = mask.pixels.at(x / 2, y / 2);
  return large;
}

/// Inserts a ring into another at point `at`, with a bridge there and back.
template <typename Points>
void join(Points& whole, std::size_t at, const Points& ring, std::size_t from) {
  Points around(ring.begin() + static_cast<std::ptrdiff_t>(from), ring.end());
  around.insert(around.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(from) + 1);
  around.push_back(whole[at]);
  whole.insert(whole.begin() + static_cast<std::ptrdiff_t>(at) + 1, around.begin(), around.end());
}

std::size_t leftmost(const Ring& ring) {
  const auto found = std::ranges::min_element(
      ring, [](const cv::Point& a, const cv::Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  return static_cast<std::size_t>(found - ring.begin());
}

/// Joins holes to the contour to their left, along the mask, in the order of their left edges: whatever ends a run of
/// pixels on the left is then joined already.
void join_holes(const cv::Mat& large, std::vector<Ring> holes, Ring& ring) {
  std::ranges::sort(holes, {}, [](const Ring& hole) { return hole[leftmost(hole)].x; });
  for (const Ring& hole : holes) {
    const std::size_t from = leftmost(hole);
    cv::Point end = hole[from];
    while (large.at<std::uint8_t>(end.y, end.x - 1) != 0) --end.x;
    const auto at = std::ranges::find(ring, end);
    join(ring, static_cast<std::size_t>(at - ring.begin()), hole, from);
  }
}

/// The parts of a mask, the largest first.
std::vector<Part> parts_of(const TargetMask& mask) {
  const cv::Mat large = enlarged(mask);
  std::vector<Ring> rings;
  std::vector<cv::Vec4i> tree;  // next, previous, first child, parent
  cv::findContours(large, rings, tree, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::Mat labels, figures, middles;  // of each part
  cv::connectedComponentsWithStats(large, labels, figures, middles, 8, CV_32S);
  std::vector<Part> parts;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    if (tree[k][3] >= 0) continue;  // a hole
    std::vector<Ring> holes;
    for (int hole = tree[k][2]; hole >= 0; hole = tree[static_cast<std::size_t>(hole)][0])
      holes.push_back(rings[static_cast<std::size_t>(hole)]);
    const int label = labels.at<int>(rings[k].front());
    Part part{.ring = rings[k], .area_px = figures.at<int>(label, cv::CC_STAT_AREA) / 4};
    join_holes(large, std::move(holes), part.ring);
    parts.push_back(std::move(part));
  }
  std::ranges::stable_sort(parts, std::greater(), &Part::area_px);
  return parts;
}

/// Removes points that repeat the one before or lie on a horizontal or vertical line between their neighbours.
Ring without_middles(const Ring& ring) {
  Ring kept;
  const auto straight = [](const cv::Point& a, const cv::Point& b, const cv::Point& c) {
    // Not where a bridge reverses direction.
    return (a.x == b.x && b.x == c.x && (b.y - a.y) * (c.y - b.y) > 0) ||
           (a.y == b.y && b.y == c.y && (b.x - a.x) * (c.x - b.x) > 0);
  };
  for (const cv::Point& point : ring) {
    if (!kept.empty() && kept.back() == point) continue;
    if (kept.size() > 1 && straight(kept[kept.size() - 2], kept.back(), point)) kept.pop_back();
    kept.push_back(point);
  }
  while (kept.size() > 1 && kept.back() == kept.front()) kept.pop_back();
  // At the ring's start and end.
  while (kept.size() > 2 && straight(kept[kept.size() - 2], kept.back(), kept.front())) kept.pop_back();
  if (kept.size() > 2 && straight(kept.back(), kept[0], kept[1])) kept.erase(kept.begin());
  return kept;
}

struct Bridge {
  std::size_t from = 0;  ///< index in `whole`
  std::size_t to = 0;    ///< index in `part`
  int between_px = std::numeric_limits<int>::max();
};

/// The shortest line from one ring to another, by the pixels between its ends.
Bridge nearest(const Ring& whole, const Ring& part) {
  Bridge best;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (std::size_t k = 0; k < part.size(); ++k) {
      const int along_px = std::abs(whole[i].x / 2 - part[k].x / 2);
      const int across_px = std::abs(whole[i].y / 2 - part[k].y / 2);
      const int between_px = std::max(along_px, across_px) - 1;
      if (between_px < best.between_px) best = {.from = i, .to = k, .between_px = between_px};
    }
  return best;
}

/// Clips a polygon to `coordinate` at most `most`, or at least that with `sign` -1 (Sutherland and Hodgman,
/// Communications of the ACM 17:32, 1974).
Outline cut_at(const Outline& polygon, double OutlinePoint::*coordinate, double most, double sign) {
  Outline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const OutlinePoint& a = polygon[i];
    const OutlinePoint& b = polygon[(i + 1) % polygon.size()];
    const double of_a = sign * (most - a.*coordinate);
    const double of_b = sign * (most - b.*coordinate);
    if (of_a >= 0) kept.push_back(a);
    if ((of_a > 0 && of_b < 0) || (of_a < 0 && of_b > 0)) {
      const double along = of_a / (of_a - of_b);
      OutlinePoint crossing{.x_px = a.x_px + along * (b.x_px - a.x_px),
                            .y_px = a.y_px + along * (b.y_px - a.y_px)};
      crossing.*coordinate = most;
      kept.push_back(crossing);
    }
  }
  return kept;
}

Outline cut_to_picture(Outline polygon, int width_px, int height_px) {
  polygon = cut_at(polygon, &OutlinePoint::x_px, width_px, 1);
  polygon = cut_at(polygon, &OutlinePoint::x_px, 0, -1);
  polygon = cut_at(polygon, &OutlinePoint::y_px, height_px, 1);
  return cut_at(polygon, &OutlinePoint::y_px, 0, -1);
}

/// The nearest corners of two polygons.
std::pair<std::size_t, std::size_t> nearest_corners(const Outline& one, const Outline& other) {
  std::pair<std::size_t, std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t k = 0; k < other.size(); ++k) {
      const double along_px = one[i].x_px - other[k].x_px;
      const double across_px = one[i].y_px - other[k].y_px;
      const double squared = along_px * along_px + across_px * across_px;
      if (squared >= least) continue;
      least = squared;
      best = {i, k};
    }
  return best;
}

double iou(int common_px, int area_px, int other_px) {
  return static_cast<double>(common_px) / (area_px + other_px - common_px);
}

}  // namespace

std::vector<Outline> edge_outlines(const TargetMask& mask) {
  std::vector<Outline> outlines;
  for (const Part& part : parts_of(mask)) {
    Ring corners;  // of pixels: both columns beside an edge are rounded to it
    for (const cv::Point& point : part.ring) corners.emplace_back((point.x + 1) / 2, (point.y + 1) / 2);
    Outline& outline = outlines.emplace_back();
    for (const cv::Point& corner : without_middles(corners))
      outline.push_back({.x_px = corner.x + 1.0 * mask.left_px, .y_px = corner.y + 1.0 * mask.top_px});
  }
  return outlines;
}

Outline filled_outline(const TargetMask& mask) {
  constexpr double kFromEdgePx = 0.02;
  std::vector<Part> parts = parts_of(mask);
  if (parts.empty()) return {};
  Ring whole = std::move(parts.front().ring);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const Bridge bridge = nearest(whole, parts[k].ring);
    if (bridge.between_px < parts[k].area_px) join(whole, bridge.from, parts[k].ring, bridge.to);
  }
  const auto within = [](int place) {
    const int pixel = place / 2;
    return pixel + (place % 2 == 0 ? kFromEdgePx : 1 - kFromEdgePx);
  };
  Outline outline;
  for (const cv::Point& point : without_middles(whole))
    outline.push_back({.x_px = mask.left_px + within(point.x), .y_px = mask.top_px + within(point.y)});
  return outline;
}

Outline joined_outline(const std::vector<Outline>& polygons, int width_px, int height_px) {
  constexpr std::size_t kMostCorners = 5000;
  Outline whole;
  std::size_t corners = 0;
  for (const Outline& polygon : polygons) {
    const Outline part = cut_to_picture(polygon, width_px, height_px);
    if (part.size() < 3) continue;
    corners += part.size();
    if (whole.empty()) {
      whole = part;
      continue;
    }
    if (corners > kMostCorners) return {};
    const auto [at, from] = nearest_corners(whole, part);
    join(whole, at, part, from);
  }
  return whole;
}

double edge_iou(const TargetMask& mask, std::span<const Outline> outlines) {
  int common_px = 0, area_px = 0, drawn_px = 0;
  for (int y = 0; y < mask.pixels.height_px(); ++y) {
    std::vector<double> crossings;  // of the ray through the centres of this row's pixels
    const double ray_y = mask.top_px + y + 0.5;
    for (const Outline& outline : outlines)
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const OutlinePoint& a = outline[k];
        const OutlinePoint& b = outline[(k + 1) % outline.size()];
        if ((a.y_px < ray_y) != (b.y_px < ray_y))
          crossings.push_back(a.x_px + (ray_y - a.y_px) / (b.y_px - a.y_px) * (b.x_px - a.x_px));
      }
    for (int x = 0; x < mask.pixels.width_px(); ++x) {
      const auto before =
          std::ranges::count_if(crossings, [&](double at) { return at < mask.left_px + x + 0.5; });
      const bool drawn = before % 2 == 1;
      const bool is_target = mask.pixels.at(x, y) != 0;
      common_px += drawn && is_target ? 1 : 0;
      drawn_px += drawn ? 1 : 0;
      area_px += is_target ? 1 : 0;
    }
  }
  return iou(common_px, area_px, drawn_px);
}

double filled_iou(const TargetMask& mask, const Outline& outline) {
  const Plane<std::uint8_t>& pixels = mask.pixels;
  cv::Mat drawn = cv::Mat::zeros(pixels.height_px(), pixels.width_px(), CV_8U);
  Ring ring;
  for (const OutlinePoint& point : outline)
    ring.emplace_back(static_cast<int>(point.x_px) - mask.left_px,
                      static_cast<int>(point.y_px) - mask.top_px);
  cv::fillPoly(drawn, std::vector<Ring>{ring}, cv::Scalar(1));
  int common_px = 0, area_px = 0;
  for (int y = 0; y < drawn.rows; ++y)
    for (int x = 0; x < drawn.cols; ++x) {
      common_px += drawn.at<std::uint8_t>(y, x) & pixels.at(x, y);
      area_px += pixels.at(x, y);
    }
  return iou(common_px, area_px, cv::countNonZero(drawn));
}

}  // namespace thermal
