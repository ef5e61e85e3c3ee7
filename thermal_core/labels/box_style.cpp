#include "labels/box_style.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace thermal {
namespace {

/// Widens [from, from + length] by a margin, clipped to [0, size] unless it exceeds that already.
void widen(double& from, double& length, double margin_px, int size_px) {
  const double end =
      std::max(from + length, std::min(from + length + margin_px, static_cast<double>(size_px)));
  from = std::min(from, std::max(from - margin_px, 0.0));
  length = end - from;
}

/// Margin on each side for a target that fills a share of the drawn box.
double filling_margin_px(double visible_px, double share) noexcept {
  constexpr double kBeyondTargetPx = 0.3;
  return std::max(0.0, 0.5 * ((visible_px - 2 * kBeyondTargetPx) / share - visible_px));
}

}  // namespace

const BoxFill& DrawnFills::of(Kind kind) const noexcept {
  if (kind == Kind::human) return people;
  return kind == Kind::animal ? animals : vehicles;
}

std::optional<DrawnFills> drawn_fills_named(std::string_view name) noexcept {
  constexpr BoxFill kHitUav = {0.67, 0.75};
  constexpr BoxFill kBirdsai = {0.59, 0.6};
  if (name == "hit_uav") return DrawnFills{kHitUav, kHitUav, kHitUav};
  if (name == "birdsai") return DrawnFills{kBirdsai, {0.54, 0.44}, kBirdsai};
  return {};
}

double drawn_margin_px(const LabelBox& visible) noexcept {
  constexpr double kLeastPx = 0.7;
  constexpr double kOfSide = 0.1;
  constexpr double kMostPx = 2.1;
  if (!(visible.area_px() > 0)) return 0;
  return std::min(kMostPx, kLeastPx + kOfSide * std::sqrt(visible.area_px()));
}

LabelBox drawn_box(const LabelBox& visible, int width_px, int height_px) noexcept {
  const double margin_px = drawn_margin_px(visible);
  LabelBox box = visible;
  widen(box.x_px, box.width_px, margin_px, width_px);
  widen(box.y_px, box.height_px, margin_px, height_px);
  return box;
}

void widen_as_drawn(LabelSet& set, const std::optional<DrawnFills>& fills) {
  for (Label& label : set.labels) {
    const LabelImage& image = set.images[label.image];
    if (!fills) {
      label.box = drawn_box(label.box, image.width_px, image.height_px);
      continue;
    }
    const BoxFill& fill = fills->of(kind_of(lower_case(set.categories[label.category].name)));
    widen(label.box.x_px, label.box.width_px, filling_margin_px(label.box.width_px, fill.width),
          image.width_px);
    widen(label.box.y_px, label.box.height_px, filling_margin_px(label.box.height_px, fill.height),
          image.height_px);
  }
}

}  // namespace thermal
