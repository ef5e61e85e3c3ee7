#pragma once

#include "imaging/scene_radiance.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Radiance [W m^-2 sr^-1] of pixels that several objects share: the mean of each object's radiance as if it were
/// alone, at the pixel's depth and normal, weighted by coverage; the uncovered rest is sky. The material plane
/// describes one surface per pixel and applies to rank 0 only; other objects have their own material. `passes.ranks`
/// must not be empty, its coverages not negative and at most 1 in total. The chain runs once for each rank and, where
/// anything is uncovered, for the sky. Radiance of completely covered pixels is exact. Rounding: with n ranks, (n + 1)
/// 2^-24 of the sum, and n 2^-25 of the sky's radiance for the rest. NaN propagates. Returns the usability of depth and
/// normals where rank 0 is a surface. `out` is reused if it has the right size. Safe to call from several threads.
PassChecks coverage_radiance(const SceneRadiance& scene, const Passes& passes, const ManifestFrame& frame,
                             Plane<float>& out);

}  // namespace thermal
