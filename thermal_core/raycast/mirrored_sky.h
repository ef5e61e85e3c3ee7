#pragma once

#include <cstddef>

#include "scene/passes.h"

namespace thermal {

/// Sets planes to this size, mirroring sky alone. Memory is reused.
void set_to_sky(Mirrored<Plane>& mirrored, int width_px, int height_px);

/// The same for lists of samples.
void set_to_sky(Mirrored<SampleList>& mirrored, std::size_t samples);

}  // namespace thermal
