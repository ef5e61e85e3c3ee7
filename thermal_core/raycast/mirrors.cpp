#include "raycast/mirrors.h"

#include <algorithm>

namespace thermal {

View mirrored(const View& view, double height_m) noexcept {
  View below = view;
  for (Vector3* axis : {&below.right, &below.down, &below.forward}) axis->z = -axis->z;
  below.position_m.z = 2 * height_m - view.position_m.z;
  return below;
}

Lanes<double> Mirror::depths_m(const VectorLanes<double>& direction) const noexcept {
  constexpr double kClearM = 1e-3;
  Lanes<double> depths_m{};
  for (std::size_t k = 0; k < kLanes; ++k)
    depths_m[k] = (height_m_ + kClearM - shot_.view.position_m.z) / direction[2][k];
  return depths_m;
}

Mirror& Mirrors::at(double height_m) {
  const auto found = std::ranges::find(made_, height_m, &Mirror::height_m);
  return found != made_.end() ? *found : made_.emplace_front(shot_, height_m);
}

}  // namespace thermal
