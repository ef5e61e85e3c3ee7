#include "raycast/pixel_rays.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

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

namespace {

/// The range enclosed by the picture's border. A lens that shows something everywhere is one-to-one from the axis to
/// there.
LensRange range_of(const CameraIntrinsics& camera, const LensDistortion& lens) {
  LensRange range;
  bool complete = true;
  const auto add = [&](int u_px, int v_px) {
    const LensPoint ray = unproject(camera, lens, {static_cast<double>(u_px), static_cast<double>(v_px)});
    range.add(ray);
    complete &= !std::isnan(ray.x);
  };
  for (int x = 0; x <= camera.width_px; ++x) {
    add(x, 0);
    add(x, camera.height_px);
  }
  for (int y = 0; y <= camera.height_px; ++y) {
    add(0, y);
    add(camera.width_px, y);
  }
  constexpr double kAll = std::numeric_limits<double>::infinity();
  return complete ? range : LensRange{.least = {-kAll, -kAll}, .most = {kAll, kAll}};
}

}  // namespace

PixelRays::PixelRays(const CameraIntrinsics& camera, const LensDistortion& lens)
    : camera_(camera), lens_(lens) {
  for (int x = 0; x < camera.width_px; ++x) x_.push_back((x + 0.5 - camera.cx_px) / camera.fx_px);
  for (int y = 0; y < camera.height_px; ++y) y_.push_back((y + 0.5 - camera.cy_px) / camera.fy_px);
  range_ = range_of(camera, lens);
  if (lens.is_none()) return;
  bent_.resize(x_.size() * y_.size());
  parallel_for(y_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * x_.size(); k < end * x_.size(); ++k)
      bent_[k] = undistort(lens, {.x = x_[k % x_.size()], .y = y_[k / x_.size()]});
  });
}

View view_of(const std::array<double, 16>& camera_to_world) noexcept {
  std::array<float, 16> m{};
  std::ranges::transform(camera_to_world, m.begin(), [](double entry) { return static_cast<float>(entry); });
  return {.right = vector_of<float>({m[0], m[4], m[8]}),
          .down = vector_of<float>({m[1], m[5], m[9]}),
          .forward = vector_of<float>({m[2], m[6], m[10]}),
          .position_m = vector_of<float>({m[3], m[7], m[11]})};
}

}  // namespace thermal
