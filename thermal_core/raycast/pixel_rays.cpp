#include "raycast/pixel_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace thermal {
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
