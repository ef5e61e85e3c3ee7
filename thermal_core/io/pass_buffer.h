#pragma once

#include <array>
#include <cstdint>

#include "base/image.h"
#include "scene/passes.h"

namespace thermal {

/// Pixels of an index channel before they have become indices.
struct IndexPixels {
  Plane<float> floats;
  Plane<std::uint32_t> wholes;
};

/// The planes of one frame, and what reading them takes beside. Given to the next reading, its memory is used again, and
/// nothing else of it: also after one that failed, which leaves it in any state.
struct PassBuffer {
  Passes passes;
  std::array<IndexPixels, 3> pixels;  ///< of objects, materials and actors
};

}  // namespace thermal
