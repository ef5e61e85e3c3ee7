#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "scene/passes.h"

namespace thermal {

/// A plane of passes that are sampled where it matters, with all samples everywhere: each pixel's value factor x factor
/// times, or its samples, which are a list of `fine`. An empty plane stays empty.
[[nodiscard]] Plane<std::uint16_t> filled_in(const Plane<std::uint16_t>& pixels,
                                             const std::vector<std::uint16_t>& samples,
                                             const FineSamples& fine);
/// The same of floats.
[[nodiscard]] Plane<float> filled_in(const Plane<float>& pixels, const std::vector<float>& samples,
                                     const FineSamples& fine);

/// All planes filled in, without samples of their own.
[[nodiscard]] Passes filled_in(const Passes& passes);

/// Which pixels have samples of their own: 1 at each of them, 0 elsewhere, as large as the planes filled in.
[[nodiscard]] Plane<std::uint16_t> sampled_places(const FineSamples& fine, int width_px);

/// The reverse: planes with factor x factor samples a pixel become those with one, and samples of the pixels for which
/// `sampled` is not 0. Only the upper left sample of a pixel counts, in `sampled` and where a pixel keeps one. Sides are
/// multiples of the factor.
[[nodiscard]] Passes separated(const Passes& full, const Plane<std::uint16_t>& sampled, int factor);

}  // namespace thermal
