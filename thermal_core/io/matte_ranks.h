#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "scene/passes.h"

namespace thermal {

/// The planes of a cryptomatte: hash, coverage, hash, coverage, …, all of one size, with the names of their channels.
struct MatteChannels {
  std::vector<std::string> names;
  std::vector<Plane<float>> planes;
};

/// Where and how often a hash has coverage.
struct MatteSpot {
  std::uint32_t hash = 0;
  std::string channel;
  int x_px = 0;
  int y_px = 0;
  std::int64_t pixels = 0;
};

/// Index of a hash's object; called once for each hash with coverage. Its exceptions pass through.
using MatteIndex = std::function<std::uint16_t(std::uint32_t hash)>;

/// Where a hash first has coverage, in row-major order and then by rank.
[[nodiscard]] MatteSpot spot_matte(const MatteChannels& mattes, std::uint32_t hash);

/// Fills object_index and ranks, as Passes has them, from a cryptomatte. Hashes of one object are summed, and a
/// pixel's objects sorted, most coverage first: files may list them otherwise (Cryptomatte specification,
/// "Alternative ranking"), and Blender 3.4.1 sometimes does. Hash 0 is nothing. Coverages with a sum above 1 are
/// scaled to 1. object_index is rank 0's, or sky where more is uncovered. DataError with channel and pixel for a
/// coverage that is negative, infinite or NaN.
void rank_mattes(const MatteChannels& mattes, const MatteIndex& index_of, Passes& passes);

}  // namespace thermal
