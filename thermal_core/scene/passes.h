#pragma once

#include <array>
#include <cstdint>

#include "base/image.h"

namespace thermal {

/// Which planes beside the object index a conversion looks at.
struct PassNeeds {
  bool depth = false;
  bool normals = false;
  bool actors = false;  ///< the manifest's actor_layer
};

/// The planes of one rendered frame, all of one size; those that were not asked for are empty.
struct Passes {
  Plane<std::uint16_t> object_index;
  Plane<std::uint16_t> material_index;  ///< empty if the file has none
  Plane<std::uint16_t>
      actor_index;       ///< of actors alone, hidden by nothing but each other; empty if there is none
  Plane<float> depth_m;  ///< along the camera's axis, not along the ray; sky: 1e9 and more
  std::array<Plane<float>, 3> normal;  ///< x, y, z in the world's frame
};

}  // namespace thermal
