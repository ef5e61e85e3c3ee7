#pragma once

#include <cstddef>

#include "raycast/ray_caster.h"
#include "support/small_scene.h"

/// Frames of the engine `embree`.
namespace small_scene {

inline constexpr thermal::PassNeeds kAllPlanes = {.depth = true, .normals = true, .actors = true};

/// All planes of a frame.
inline thermal::Passes traced(const Scenery& place, Clip& clip, const CameraIntrinsics& camera,
                              std::size_t frame = 0, const thermal::LensDistortion& lens = {}) {
  const thermal::BakedScene scene = place.baked();
  const thermal::RayCaster caster(scene);
  const thermal::BakedTrack track = clip.baked();
  thermal::Passes passes;
  thermal::ClipTracer(caster, track, camera, {.lens = lens}).trace(frame, kAllPlanes, passes);
  return passes;
}

inline bool same_planes(const thermal::Passes& a, const thermal::Passes& b) {
  return a.object_index == b.object_index && a.material_index == b.material_index &&
         a.actor_index == b.actor_index && a.depth_m == b.depth_m && a.normal == b.normal;
}

}  // namespace small_scene
