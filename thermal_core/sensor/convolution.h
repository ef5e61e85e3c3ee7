#pragma once

#include <vector>

#include "base/image.h"

namespace thermal {

/// Weights of a symmetric kernel at distances 0, 1, …, radius. With the mirrored half they sum to 1.
using HalfKernel = std::vector<float>;

/// A Gaussian of this standard deviation [px], sampled at pixel centres, cut at 4 sigma. sigma_px 0: {1}.
/// Requires sigma_px >= 0 and finite.
[[nodiscard]] HalfKernel gaussian_kernel(double sigma_px);

/// Rounds weights to float so that their sum stays 1 within 6e-8: the middle takes what rounding leaves.
[[nodiscard]] HalfKernel rounded_kernel(const std::vector<double>& half_weights);

/// Convolves pictures with the same kernel across and down. Beyond the border the picture is mirrored (edge pixel
/// repeated), which keeps the sum of all pixels to rounding. Holds memory that is used again.
class Convolution {
 public:
  explicit Convolution(HalfKernel kernel) : kernel_(std::move(kernel)) {}

  [[nodiscard]] const HalfKernel& kernel() const noexcept { return kernel_; }

  /// Replaces the picture. NaN spreads as far as the kernel reaches. Same bits whatever the number of threads.
  void apply(Plane<float>& picture);

 private:
  HalfKernel kernel_;
  Plane<float> across_;
};

}  // namespace thermal
