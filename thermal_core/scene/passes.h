#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace thermal {

/// Renderers write this depth and more where there is nothing.
inline constexpr float kSkyFromM = 1e9F;

/// Which planes beside the object index a conversion looks at.
struct PassNeeds {
  bool depth = false;
  bool normals = false;
  bool actors = false;  ///< the manifest's actor_layer
};

/// One of the objects that share a pixel, and how much of it that one fills.
struct CoverageRank {
  Plane<std::uint16_t> object_index;
  Plane<float> coverage;  ///< 0 to 1
};

/// The planes of one rendered frame, all of one size; those that were not asked for are empty.
struct Passes {
  Plane<std::uint16_t> object_index;
  Plane<std::uint16_t> material_index;  ///< empty if the file has none
  Plane<std::uint16_t>
      actor_index;       ///< of actors alone, hidden by nothing but each other; empty if there is none
  Plane<float> depth_m;  ///< along the camera's axis, not along the ray; sky: 1e9 and more
  std::array<Plane<float>, 3> normal;  ///< x, y, z in the world's frame
  /// Where several objects share a pixel and the file tells of each: radiance is the mean over these, what they leave
  /// of a pixel is sky, and `object_index` is what fills most of it. Empty: that plane is all there is.
  std::vector<CoverageRank> ranks;
};

}  // namespace thermal
