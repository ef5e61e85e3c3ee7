#pragma once

#include <array>
#include <cstdint>

#include "base/image.h"
#include "scene/passes.h"

namespace thermal {

/// Limits on what a file of passes may claim, checked before memory is allocated for it.
struct ReadLimits {
  std::int64_t pixels = 256'000'000;  ///< of a plane
};

/// Pixels of an index channel before conversion to indices.
struct IndexPixels {
  Plane<float> floats;
  Plane<std::uint32_t> wholes;
};

/// The planes of one frame, and scratch memory to read them. Reusing a buffer reuses only its memory, not its
/// contents: also after a failed read, which leaves it in an unspecified state.
struct PassBuffer {
  Passes passes;
  /// Indices of objects, materials, actors, mirrored objects and their materials, and the mask of sampled pixels.
  std::array<IndexPixels, 6> pixels;
};

}  // namespace thermal
