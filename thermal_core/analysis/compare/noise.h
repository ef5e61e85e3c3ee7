#pragma once

#include <optional>
#include <vector>

#include "base/image.h"

namespace thermal {

/// Noise within the flattest parts of a frame, and its correlation between neighbouring pixels: filters and codecs
/// correlate noise, detectors do not.
struct FlatNoise {
  double deviation = 0;                   ///< grey levels
  std::optional<double> along_rows = {};  ///< correlation of neighbours in a row; empty: no noise
  std::optional<double> diagonal = {};    ///< of neighbours across a corner
};

/// Computed from blocks of 16 x 16 px, minus a plane fitted to each: the first decile of their deviations, and the
/// median correlations of that decile. For white noise the deviation is 6 % too low (scatter between blocks is 4.4 %),
/// and correlations are 0. A Gaussian filter of sigma leaves exp(-d^2 / (4 sigma^2)), of which the planes and the
/// choice of flat blocks remove a share: .59 is left of .68, for sigma = 0.8 px. Blocks that are partly black or white
/// are left out. Empty with fewer than 10 blocks.
[[nodiscard]] std::optional<FlatNoise> flat_noise(const Plane<float>& frame);

/// Temporal components of the three-dimensional noise model (D'Agostino and Webb, Proc. SPIE 1488, 1991), deviations in
/// grey levels. Whatever is constant over the frames counts as scene.
struct VideoNoise {
  double random = 0;   ///< sigma_tvh: each pixel and frame
  double rows = 0;     ///< sigma_tv: each row and frame
  double columns = 0;  ///< sigma_th: each column and frame
  double frames = 0;   ///< sigma_t: each frame
};

/// Frames of one size, at least 2 in number, rows and columns. Unbiased in variance; a negative one counts as 0.
[[nodiscard]] VideoNoise video_noise(const std::vector<Plane<float>>& frames);

/// Whether frames show a static scene: they are of one size, and the first and the last, blurred by 2 px, correlate to
/// .9 or more and are less than a tenth of a pixel apart, by least squares.
[[nodiscard]] bool is_still(const std::vector<Plane<float>>& frames);

}  // namespace thermal
