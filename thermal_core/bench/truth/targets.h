#pragma once

#include <string>
#include <vector>

#include "base/image.h"
#include "bench/truth/optics.h"

namespace thermal {

/// An ellipse or a rectangle about a centre; lengths are half sides.
struct TruthShape {
  bool is_ellipse = true;
  double x = 0;
  double y = 0;
  double half_x = 1;
  double half_y = 1;
};

/// A silhouette from straight above, of one temperature. Its shapes are in metres, or in pixels.
struct TruthTarget {
  std::string name;
  GreySurface surface;
  std::vector<TruthShape> shapes;
  double walks_m_s = 0;
  bool in_px = false;
};

/// Person, impala, elephant, truck and fire as simple shapes of true size; targets of 1 and 0.3 px; an edge and bars of
/// 6 px.
[[nodiscard]] std::vector<TruthTarget> truth_targets();
[[nodiscard]] const TruthTarget& truth_target(const std::vector<TruthTarget>& targets,
                                              const std::string& name);

/// The target in pixels, moved to a position.
[[nodiscard]] std::vector<TruthShape> placed(const TruthTarget& target, double px_per_m, double x_px,
                                             double y_px);

[[nodiscard]] bool is_inside(const std::vector<TruthShape>& shapes, double x_px, double y_px) noexcept;

/// Part of the target on a line of an image.
struct TruthStretch {
  double begin_px = 0;
  double end_px = 0;
  double share = 1;  ///< of the line's height that the target reaches
};

/// The stretches of the line between two heights, disjoint, from left to right. Along an ellipse's edge they have its
/// mean width, so that a target's area is exact.
[[nodiscard]] std::vector<TruthStretch> stretches_between(const std::vector<TruthShape>& shapes,
                                                          double top_px, double bottom_px);

/// The smallest rectangle around all shapes.
[[nodiscard]] TruthShape bounds_of(const std::vector<TruthShape>& shapes);

/// Radiance of each pixel [W m^-2 sr^-1] of a target in front of ground of this radiance.
/// @param samples  0: lines with exact edges. Otherwise only this many rays across a pixel see the target, as in a
/// renderer, with exact optics: the error of sampling alone
[[nodiscard]] Plane<double> true_radiance(const ContrastKernel& kernel, const std::vector<TruthShape>& shapes,
                                          double ground_w_m2_sr, int width_px, int height_px,
                                          int samples = 0);

}  // namespace thermal
