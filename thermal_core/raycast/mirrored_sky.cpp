#include "raycast/mirrored_sky.h"

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

}  // namespace thermal
