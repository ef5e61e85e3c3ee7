#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "sensor/optics/convolution.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Temporal noise reduction as in cameras: each pixel is a recursive mean of its frames, with a motion detector. A
/// pixel whose change exceeds the noise, alone or averaged over its 3 x 3 neighbourhood, takes its new value at once.
/// (With the pixel alone, moving texture of a few standard deviations would trail in some pixels and not in others,
/// which looks like noise.)
///
/// White noise of a still scene keeps share / (2 - share) of its variance: 1/3 for a share of 0.5. The difference of a
/// new value from the mean has sqrt(2 / (2 - share)) times the noise's standard deviation; the limit is `motion_sigma`
/// of these for a pixel and a third of that for nine. Smaller changes trail behind.
class TemporalFilter {
 public:
  /// @param noise_w_m2_sr  standard deviation of a pixel's white noise
  TemporalFilter(const DenoiseParameters& parameters, float noise_w_m2_sr);

  /// Passes the next frame unchanged, as the first: after the shutter, pixels have other offsets.
  void restart() noexcept { mean_.clear(); }

  /// Replaces the next frame by the mean. Frames are of one size.
  void apply(Plane<float>& signal_w_m2_sr);

 private:
  void take_changes(const Plane<float>& signal_w_m2_sr);
  void follow_row(int y, Plane<float>& signal_w_m2_sr);

  float share_;
  float limit_w_m2_sr_;
  std::vector<float> mean_;
  Plane<float> change_;  ///< of a frame from the mean
};

/// Filters of a camera's processor ahead of gain control: a Gaussian noise filter, then an unsharp mask, which leaves
/// halos. Modulation transfer along rows or columns, with N and U those of gaussian_psf():
///   H(f) = N(f) (1 + amount (1 - U(f))),
/// within 0.03 (1 + amount) of exp(-2 pi^2 sigma^2 f^2) in place of N and U. Filtered white noise has a correlation of
/// exp(-d^2 / (4 sigma^2)) between pixels at a distance d, without an unsharp mask. Beyond the border, the picture is
/// mirrored.
class Processing {
 public:
  explicit Processing(const ProcessingParameters& parameters);

  /// The filtered counts, valid until the next call; `ir16` itself if there is no filter. Counts 0 (no signal) and
  /// 65535 (clipped) are unchanged, and no other becomes one of them.
  [[nodiscard]] const Plane<std::uint16_t>& filter(const Plane<std::uint16_t>& ir16);

 private:
  float unsharp_amount_;
  HalfKernel noise_filter_;
  HalfKernel blur_;  ///< noise filter and the unsharp mask's
  Plane<std::uint16_t> filtered_;
};

/// The detail of a picture: its counts minus an edge-preserving base, the guided filter of the picture by itself (He,
/// Sun and Tang, ECCV 2010; for infrared pictures Liu and Zhao, Infrared Physics & Technology 67, 2014): windows whose
/// standard deviation is far below `edge_counts` are smoothed to their mean, those far above keep their edges. Edge
/// pixels are replicated beyond the border.
void find_detail(const Plane<std::uint16_t>& ir16, int radius_px, double edge_counts,
                 Plane<float>& detail_counts);

/// Sharpens 8-bit frames, which cameras do in the 8-bit output alone (FLIR's "digital detail enhancement"): adds the
/// detail of their 16-bit frames, minus the part that noise explains, times a gain.
class DetailEnhancer {
 public:
  DetailEnhancer(const AgcParameters& parameters, double counts_per_netd);

  /// A pixel of detail d, in NETDs, becomes gain x (|d| - noise) levels warmer, or colder if d < 0; unchanged if |d| is
  /// at most `noise`; clipped to black_level and white_level. Counts 0 (no signal) and 65535 (clipped) are unchanged,
  /// as is everything without a gain.
  void sharpen(const Plane<std::uint16_t>& ir16, Plane<std::uint8_t>& ir8);

 private:
  DetailParameters parameters_;
  bool is_inverted_;
  float darkest_;
  float brightest_;
  double counts_per_netd_;
  Plane<float> detail_counts_;
};

}  // namespace thermal
