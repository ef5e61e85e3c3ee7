#include "dataset/reports/seen_ground.h"

#include <cmath>

#include "io/lens_config.h"

namespace thermal {

std::vector<std::array<double, 2>> seen_ground(const std::array<double, 16>& camera_to_world, double agl_m,
                                               const Json& camera) {
  constexpr double kFarthest = 5;
  const auto& m = camera_to_world;
  const CameraIntrinsics pinhole = read_intrinsics(camera);
  const double left = -pinhole.cx_px / pinhole.fx_px;
  const double up = -pinhole.cy_px / pinhole.fy_px;
  const double right = (pinhole.width_px - pinhole.cx_px) / pinhole.fx_px;
  const double down = (pinhole.height_px - pinhole.cy_px) / pinhole.fy_px;
  std::vector<std::array<double, 2>> corners;
  for (const auto& [x, y] : {std::array{left, up}, {right, up}, {right, down}, {left, down}}) {
    const std::array ray = {m[0] * x + m[1] * y + m[2], m[4] * x + m[5] * y + m[6],
                            m[8] * x + m[9] * y + m[10]};
    const double run = std::hypot(ray[0], ray[1]);
    if (ray[2] >= 0 || run > -kFarthest * ray[2]) return {};
    corners.push_back({m[3] - ray[0] / ray[2] * agl_m, m[7] - ray[1] / ray[2] * agl_m});
  }
  return corners;
}

}  // namespace thermal
