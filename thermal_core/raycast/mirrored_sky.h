#pragma once

#include <cstddef>

#include "scene/passes.h"

namespace thermal {

inline constexpr float kSkyDepthM = 1e10F;  ///< as Blender has it

/// Makes planes this large that mirror nothing but sky. Memory is reused.
void set_to_sky(Mirrored<Plane>& mirrored, int width_px, int height_px);

/// The same for lists of samples.
void set_to_sky(Mirrored<SampleList>& mirrored, std::size_t samples);

}  // namespace thermal
