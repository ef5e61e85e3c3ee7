#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/image.h"

namespace thermal {

/// 8 bits.
inline constexpr std::size_t kGreyLevels = 256;

/// Use of the grey levels 0 to 255 by a frame.
struct GreyLevels {
  double mean = 0;
  double deviation = 0;
  double low = 0;          ///< 1st percentile
  double high = 0;         ///< 99th
  double empty_share = 0;  ///< share of unused levels from `low` to `high`: a comb
  double roughness =
      0;  ///< mean step between neighbouring levels' counts there over the mean count; 2 of a full comb
  std::array<double, kGreyLevels> shares{};  ///< of the pixels, by level

  [[nodiscard]] double range() const noexcept { return high - low; }
};

/// @param frame  levels 0 to 255; fractions are rounded
[[nodiscard]] GreyLevels grey_levels(const Plane<float>& frame);

/// Edges of the bands of a frame's spectrum, cycles a pixel: octaves, and finer ones where cameras blur.
inline constexpr std::array kBandEdges = {0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.25, 0.35, 0.5};
/// Number of bands.
inline constexpr std::size_t kBands = kBandEdges.size() - 1;

/// Power spectrum of a frame by radial frequency.
struct RadialPower {
  std::array<double, kBands> bands{};  ///< mean over the frequencies of a band; 0 if it has none
  std::vector<double> curve;           ///< the same between curve_edges()
};

/// Edges of a finer curve for pictures: logarithmic, 0.004 to 0.5 cycles a pixel.
[[nodiscard]] const std::vector<double>& curve_edges();

/// Squared magnitude of the Fourier transform, not normalised, of the frame minus its mean under Hann's window
/// (symmetric), scaled by 640 x 512 px over the frame's pixels, so that white noise has the same power in frames of all
/// sizes.
[[nodiscard]] RadialPower radial_power(const Plane<float>& frame);

/// Structure of a frame besides its spectrum and its grey levels. Frames have levels of 0 to 255 and 16 x 16 px at
/// least; empty values are undefined for a uniform frame.
struct Structure {
  std::optional<double> stripes;  ///< stripe_excess()
  std::optional<double> spots;    ///< spot_balance()
  std::optional<double> tails;    ///< wavelet_kurtosis()
  double line_px = 0;             ///< longest_line_px()
};

/// How much more rows differ than columns, log10: of the squared second differences of the means of rows and of
/// columns, each times the pixels of a mean. White noise of variance V and independent row noise of variance R, over W
/// px, give log10(1 + W R / V).
[[nodiscard]] std::optional<double> stripe_excess(const Plane<float>& frame);

/// Ratio of warm to dark spots, log10 of their numbers, each plus one. Spots are maxima within 6 px of a difference of
/// Gaussians of sigma 2 and 3.2 px, which excludes the ring around a spot; they exceed half a level and 3 standard
/// deviations, which are estimated from the median magnitude. 0 for noise, and for frames whose warm and cold objects
/// are alike.
[[nodiscard]] double spot_balance(const Plane<float>& frame);

/// Kurtosis of Haar's wavelet coefficients of level 2 (means over 2 x 2 px minus those of their neighbours), averaged
/// over the three orientations: 3 for normal noise, large for few edges in smooth surroundings.
[[nodiscard]] std::optional<double> wavelet_kurtosis(const Plane<float>& frame);

/// Longest straight line among the edges: Canny's, thresholds of 40 and 80 levels by Sobel's operator after a blur of
/// 1.5 px, joined across 8 px by OpenCV's probabilistic Hough transform; 0 if none has 30 px. Understates lines by a
/// few pixels at their ends, and overstates wide ones.
[[nodiscard]] double longest_line_px(const Plane<float>& frame);

/// All of these.
[[nodiscard]] Structure structure_of(const Plane<float>& frame);

}  // namespace thermal
