#include "raycast/mirrors.h"

#include <algorithm>

namespace thermal {
namespace {

template <typename Value>
void set_all(Plane<Value>& plane, int width_px, int height_px, Value value) {
  plane.resize(width_px, height_px);
  std::ranges::fill(plane.pixels(), value);
}

}  // namespace

void set_to_sky(Mirrored<Plane>& mirrored, int width_px, int height_px) {
  for (auto* indices : {&mirrored.object_index, &mirrored.material_index})
    set_all<std::uint16_t>(*indices, width_px, height_px, 0);
  set_all(mirrored.depth_m, width_px, height_px, kSkyDepthM);
  for (Plane<float>& axis : mirrored.normal) set_all(axis, width_px, height_px, 0.0F);
}

void set_to_sky(Mirrored<SampleList>& mirrored, std::size_t samples) {
  for (auto* indices : {&mirrored.object_index, &mirrored.material_index}) indices->assign(samples, 0);
  mirrored.depth_m.assign(samples, kSkyDepthM);
  for (std::vector<float>& axis : mirrored.normal) axis.assign(samples, 0);
}

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
