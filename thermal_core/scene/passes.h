#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace thermal {

/// Renderers write this depth or more where there is no surface.
inline constexpr float kSkyFromM = 1e9F;

/// Planes that a conversion needs besides the object index.
struct PassNeeds {
  bool depth = false;
  bool normals = false;
  bool actors = false;  ///< the manifest's actor_layer
};

/// One of the objects that share a pixel, and the fraction of the pixel it covers.
struct CoverageRank {
  Plane<std::uint16_t> object_index;
  Plane<float> coverage;  ///< 0 to 1
};

/// The planes of one rendered frame, all of one size; planes that were not requested are empty.
struct Passes {
  Plane<std::uint16_t> object_index;
  Plane<std::uint16_t> material_index;  ///< empty if absent from the file
  Plane<std::uint16_t> actor_index;     ///< of actors alone, hidden only by each other; empty if absent
  Plane<float> depth_m;                 ///< along the camera's axis, not along the ray; sky: 1e9 or more
  std::array<Plane<float>, 3> normal;   ///< x, y, z in world axes
  /// For files that list the objects sharing a pixel: radiance is the mean over these, the rest of a pixel is sky,
  /// and `object_index` is the object that covers most of it. Empty: `object_index` is all there is.
  std::vector<CoverageRank> ranks;
};

}  // namespace thermal
