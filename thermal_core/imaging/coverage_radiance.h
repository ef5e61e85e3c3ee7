#pragma once

#include "imaging/scene_radiance.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Radiance [W m^-2 sr^-1] of pixels that several objects share: the mean of what each would be seen at alone, at the
/// pixel's depth and normal, weighted by coverage; what they leave is sky. The material plane knows one surface a pixel
/// and counts for rank 0 alone; other objects are of their own material.
/// `passes.ranks` must not be empty, its coverages not negative and in sum at most 1. The chain runs once for each rank
/// and, where anything is left, for the sky. Objects that cover their pixels wholly keep every bit of their radiance.
/// Rounding: with n ranks, (n + 1) 2^-24 of the sum, and n 2^-25 of the sky's radiance for what is left. NaN spreads.
/// `out` is used again if it has the right size. Safe to call from several threads.
void coverage_radiance(const SceneRadiance& scene, const Passes& passes, const ManifestFrame& frame,
                       Plane<float>& out);

}  // namespace thermal
