#pragma once

#include "raycast/pixel_rays.h"
#include "raycast/shot.h"
#include "scene/passes.h"

namespace thermal {

/// Fills the planes of `out` that are needed, and both indices. `near_actors`: pixels whose ray may hit an actor.
void trace_pixels(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                  const PassNeeds& needs, Passes& out);

/// Fills the lists of `fine` that are needed, and both indices; its pixels are set. `rays` are those of samples,
/// `near_actors` of pixels.
void trace_samples(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                   const PassNeeds& needs, FineSamples& fine);

}  // namespace thermal
