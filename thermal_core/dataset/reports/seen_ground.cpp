#include "dataset/reports/seen_ground.h"

#include <cmath>

namespace thermal {

std::vector<std::array<double, 2>> seen_ground(const std::array<double, 16>& camera_to_world, double agl_m,
                                               const Json& camera) {
  constexpr double kFarthest = 5;
  const auto& m = camera_to_world;
  const double pixel =
      1e-6 * camera.at("pixel_pitch_um").get<double>() / camera.at("focal_length_m").get<double>();
  const double right = 0.5 * pixel * camera.at("width_px").get<double>();
  const double down = 0.5 * pixel * camera.at("height_px").get<double>();
  std::vector<std::array<double, 2>> corners;
  for (const auto& [x, y] : {std::array{-right, -down}, {right, -down}, {right, down}, {-right, down}}) {
    const std::array ray = {m[0] * x + m[1] * y + m[2], m[4] * x + m[5] * y + m[6],
                            m[8] * x + m[9] * y + m[10]};
    const double run = std::hypot(ray[0], ray[1]);
    if (ray[2] >= 0 || run > -kFarthest * ray[2]) return {};
    corners.push_back({m[3] - ray[0] / ray[2] * agl_m, m[7] - ray[1] / ray[2] * agl_m});
  }
  return corners;
}

}  // namespace thermal
