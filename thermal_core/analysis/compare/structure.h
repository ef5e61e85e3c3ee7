#pragma once

#include <optional>

#include "base/image.h"

namespace thermal {

/// What gives a frame away besides its spectrum and its grey levels. Frames have levels of 0 to 255 and 16 x 16 px at
/// least; unknown is what a level frame has nothing of.
struct Structure {
  std::optional<double> stripes;  ///< stripe_excess()
  std::optional<double> spots;    ///< spot_balance()
  std::optional<double> tails;    ///< wavelet_kurtosis()
  double line_px = 0;             ///< longest_line_px()
};

/// How much more rows differ than columns, log10: of the squared second differences of the means of rows and of columns,
/// each times the pixels of a mean. White noise of variance V and rows of variance R that differ by themselves, over W
/// px, give log10(1 + W R / V).
[[nodiscard]] std::optional<double> stripe_excess(const Plane<float>& frame);

/// Warm spots over dark ones, log10 of their numbers, of each one more. Spots are where a difference of Gaussians of
/// sigma 2 and 3.2 px is stronger than within 6 px around, so that the ring of a spot is none, and beyond 3 of its standard
/// deviations, which is estimated by the median magnitude, and half a level. 0 of noise, and of frames whose warm and cold
/// things are alike.
[[nodiscard]] double spot_balance(const Plane<float>& frame);

/// Kurtosis of Haar's wavelet coefficients of level 2 (means over 2 x 2 px less those of their neighbours), averaged over
/// the three orientations: 3 of normal noise, large where few edges stand out of much that is smooth.
[[nodiscard]] std::optional<double> wavelet_kurtosis(const Plane<float>& frame);

/// Longest straight line among the edges: Canny's, thresholds of 40 and 80 levels by Sobel's operator after a blur of 1.5
/// px, joined across 8 px by OpenCV's probabilistic Hough transform; 0 if none has 30 px. Shorter by a few pixels at its
/// ends, and longer where it is wide.
[[nodiscard]] double longest_line_px(const Plane<float>& frame);

/// All of them.
[[nodiscard]] Structure structure_of(const Plane<float>& frame);

}  // namespace thermal
