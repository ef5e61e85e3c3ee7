#pragma once

#include "base/image.h"

namespace thermal {

/// Convolves with a Gaussian of this standard deviation [px], sampled at pixel centres, cut at 4 sigma and
/// normalised. Beyond the border the picture is mirrored (edge pixel repeated), which keeps the sum of all
/// pixels to rounding. 0 copies. Requires sigma_px >= 0 and finite.
[[nodiscard]] Plane<float> gaussian_blur(const Plane<float>& picture, double sigma_px);

}  // namespace thermal
