#pragma once

#include <cstdint>
#include <span>

#include "base/image.h"
#include "labels/instances.h"

namespace thermal {

/// Means of blocks of factor x factor pixels; sides must be multiples of it. NaN spreads to its block.
[[nodiscard]] Plane<float> block_means(const Plane<float>& fine, int factor);

/// Index that labels go by: in each block of factor x factor pixels, the actor that covers at least half of it,
/// else 0. Two actors that cover half each: the lower index. `uses` is the fine plane's survey; no pixel outside the
/// actors' boxes is read.
[[nodiscard]] Plane<std::uint16_t> block_actors(const Plane<std::uint16_t>& fine, int factor,
                                                std::span<const IndexUse> uses, const IndexSet& actors);

}  // namespace thermal
