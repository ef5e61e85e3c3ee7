#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "scene/passes.h"

namespace thermal {

/// Expands a plane of adaptively sampled passes to factor x factor values a pixel: its own samples, a list of `fine`,
/// or its value repeated. An empty plane stays empty.
[[nodiscard]] Plane<std::uint16_t> filled_in(const Plane<std::uint16_t>& pixels,
                                             const std::vector<std::uint16_t>& samples,
                                             const FineSamples& fine);
/// The same of floats.
[[nodiscard]] Plane<float> filled_in(const Plane<float>& pixels, const std::vector<float>& samples,
                                     const FineSamples& fine);

/// All planes expanded, without `fine`.
[[nodiscard]] Passes filled_in(const Passes& passes);

/// Which pixels have samples of their own: 1 there, 0 elsewhere, of the expanded size.
[[nodiscard]] Plane<std::uint16_t> sampled_mask(const FineSamples& fine, int width_px);

/// The reverse: planes with factor x factor samples a pixel become those with one, and samples of the pixels for which
/// `sampled` is not 0. Only the upper left sample of a pixel counts, in `sampled` and where a pixel keeps one. Sides are
/// multiples of the factor.
[[nodiscard]] Passes separated(const Passes& full, const Plane<std::uint16_t>& sampled, int factor);

}  // namespace thermal
