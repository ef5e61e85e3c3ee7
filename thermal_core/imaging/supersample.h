#pragma once

#include <cstdint>
#include <span>

#include "base/image.h"
#include "labels/instances.h"
#include "scene/passes.h"

namespace thermal {

/// Means of blocks of factor x factor pixels; sides must be multiples of it. NaN propagates to its block.
[[nodiscard]] Plane<float> block_means(const Plane<float>& fine, int factor);

/// Index plane for labels: in each block of factor x factor pixels, the actor that covers at least half of it,
/// otherwise 0. If two actors cover half each: the lower index. `uses` is the fine plane's survey; pixels outside the
/// actors' boxes are not read.
[[nodiscard]] Plane<std::uint16_t> block_actors(const Plane<std::uint16_t>& fine, int factor,
                                                std::span<const IndexUse> uses, const IndexSet& actors);

}  // namespace thermal
