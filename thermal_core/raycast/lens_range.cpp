#include "raycast/lens_range.h"

#include <algorithm>

namespace thermal {
namespace {

struct Interval {
  double low = 0;
  double high = 0;
};

Interval operator+(const Interval& a, const Interval& b) noexcept { return {a.low + b.low, a.high + b.high}; }

Interval operator*(const Interval& a, const Interval& b) noexcept {
  const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

Interval operator*(double factor, const Interval& a) noexcept { return Interval{factor, factor} * a; }

/// Tighter than the product of two independent intervals.
Interval square(const Interval& a) noexcept {
  const auto [low, high] = std::minmax({a.low * a.low, a.high * a.high});
  return {a.low < 0 && a.high > 0 ? 0 : low, high};
}

}  // namespace

void LensRange::add(const LensPoint& point) noexcept {
  least = {.x = std::min(least.x, point.x), .y = std::min(least.y, point.y)};
  most = {.x = std::max(most.x, point.x), .y = std::max(most.y, point.y)};
}

LensRange common(const LensRange& a, const LensRange& b) noexcept {
  return {.least = {.x = std::max(a.least.x, b.least.x), .y = std::max(a.least.y, b.least.y)},
          .most = {.x = std::min(a.most.x, b.most.x), .y = std::min(a.most.y, b.most.y)}};
}

LensRange distort(const LensDistortion& lens, const LensRange& range) noexcept {
  const Interval x = {range.least.x, range.most.x};
  const Interval y = {range.least.y, range.most.y};
  const Interval r2 = square(x) + square(y);
  const Interval radial = Interval{1, 1} + lens.k1 * r2 + lens.k2 * square(r2) + lens.k3 * (r2 * square(r2));
  const Interval shown_x = x * radial + 2 * lens.p1 * (x * y) + lens.p2 * (r2 + 2 * square(x));
  const Interval shown_y = y * radial + lens.p1 * (r2 + 2 * square(y)) + 2 * lens.p2 * (x * y);
  return {.least = {.x = shown_x.low, .y = shown_y.low}, .most = {.x = shown_x.high, .y = shown_y.high}};
}

}  // namespace thermal
