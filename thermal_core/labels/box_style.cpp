#include "labels/box_style.h"

#include <algorithm>
#include <cmath>

namespace thermal {
namespace {

/// The part [from, from + length] widened by a margin, and cut to [0, size] unless it was beyond already.
void widen(double& from, double& length, double margin_px, int size_px) {
  const double end =
      std::max(from + length, std::min(from + length + margin_px, static_cast<double>(size_px)));
  from = std::min(from, std::max(from - margin_px, 0.0));
  length = end - from;
}

}  // namespace

double drawn_margin_px(const LabelBox& visible) noexcept {
  constexpr double kLeastPx = 0.7;
  constexpr double kOfSide = 0.1;
  constexpr double kMostPx = 2.1;
  if (!(visible.area_px() > 0)) return 0;
  return std::min(kMostPx, kLeastPx + kOfSide * std::sqrt(visible.area_px()));
}

void widen_as_drawn(LabelSet& set) {
  for (Label& label : set.labels) {
    const LabelImage& image = set.images[label.image];
    const double margin_px = drawn_margin_px(label.box);
    widen(label.box.x_px, label.box.width_px, margin_px, image.width_px);
    widen(label.box.y_px, label.box.height_px, margin_px, image.height_px);
  }
}

}  // namespace thermal
