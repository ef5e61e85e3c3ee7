#pragma once

#include <cstdint>

#include "base/image.h"

namespace thermal {

/// Marks with 1 the pixels at which the picture changes by more than `threshold_counts` from one neighbour to the
/// opposite one, along rows or columns, averaged over three parallel lines (Prewitt's operator), and others with 0.
/// White noise of 1 NETD changes that mean by sqrt(2 / 3) NETD. Edge pixels are replicated beyond the border.
void mark_information(const Plane<std::uint16_t>& ir16, double threshold_counts, Plane<std::uint8_t>& marks);

}  // namespace thermal
