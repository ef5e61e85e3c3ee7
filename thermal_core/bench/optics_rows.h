#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// Point spreads of the optics, and the lens's distortion. mtf_rows: worst difference between the kernel's transfer and
/// the physics along rows up to Nyquist; mtf_plane: the same in two dimensions, each up to Nyquist, against a round lens,
/// a square pixel and a Gaussian; energy: relative change of the sum of all pixels. Where quarters of pixels are known,
/// time is with detail in all pixels. Distortion: bilinear interpolation against the scene at the true position.
[[nodiscard]] std::vector<StageRow> optics_rows();

}  // namespace thermal
