#pragma once

#include <span>
#include <vector>

#include "base/image.h"

namespace thermal {

/// Index in [0, size) of the pixel that a picture mirrored at its border (edge pixel repeated) has at `at`.
[[nodiscard]] int mirrored(int at, int size) noexcept;

/// Weights of a symmetric kernel at distances 0, 1, …, radius. With the mirrored half they sum to 1.
using HalfKernel = std::vector<float>;

/// A Gaussian of this standard deviation [px], sampled at pixel centres, truncated at 4 sigma. sigma_px 0: {1}.
/// Requires sigma_px >= 0 and finite.
[[nodiscard]] HalfKernel gaussian_kernel(double sigma_px);

/// Rounds weights to float so that their sum stays 1 within 6e-8: the centre weight absorbs the rounding.
[[nodiscard]] HalfKernel rounded_kernel(const std::vector<double>& half_weights);

/// A row convolved with a kernel, mirrored at its ends. `padded` is a buffer for reuse.
void convolve_row(std::span<const float> row, const HalfKernel& kernel, std::vector<float>& padded,
                  std::span<float> out);

/// Convolves pictures with the same kernel along rows and columns. Pictures are mirrored at the border (edge pixel
/// repeated), which preserves the sum of all pixels up to rounding. Keeps its buffers for reuse.
/// Not cv::sepFilter2D(): the order of its sums depends on the processor, and bits must not.
class Convolution {
 public:
  explicit Convolution(HalfKernel kernel) : kernel_(std::move(kernel)) {}

  [[nodiscard]] const HalfKernel& kernel() const noexcept { return kernel_; }

  /// Convolves in place. NaN spreads over the kernel's radius. The result does not depend on the number of threads.
  void apply(Plane<float>& picture);

 private:
  HalfKernel kernel_;
  Plane<float> across_;
};

}  // namespace thermal
