#pragma once

#include <cstdint>

#include "base/image.h"
#include "sensor/convolution.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

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

}  // namespace thermal
