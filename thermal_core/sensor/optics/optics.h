#pragma once

#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/image.h"
#include "radiometry/spectral_response.h"
#include "sensor/optics/convolution.h"
#include "sensor/optics/round_kernel.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Applies a RoundKernel to pictures. Pictures are mirrored at the border (edge pixel repeated), which preserves the sum
/// of all pixels up to rounding, if whole halo blocks fit. Keeps its buffers for reuse. The result does not depend on
/// the number of threads.
class RoundConvolution {
 public:
  explicit RoundConvolution(RoundKernel kernel) : kernel_(std::move(kernel)) {}

  [[nodiscard]] const RoundKernel& kernel() const noexcept { return kernel_; }

  /// Convolves in place. `detail` is empty, or of the picture's size.
  void apply(const SubpixelDetail& detail, Plane<float>& picture);

 private:
  /// Columns of a row that have detail.
  struct Extent {
    int begin = 0;
    int end = 0;
  };
  class RowSums;

  void find_extents(const SubpixelDetail& detail);
  void make_halo(const Plane<float>& picture);
  [[nodiscard]] Extent extent_around(int y) const;
  void add_detail(const SubpixelDetail& detail, int y, RowSums& sums, std::span<float> out) const;
  void add_halo(int y, std::vector<float>& blocks, std::span<float> out) const;

  RoundKernel kernel_;
  Plane<float> out_;
  Plane<float> blocks_;          ///< means of blocks
  Plane<float> halo_;            ///< the same, spread
  std::vector<Extent> extents_;  ///< of the rows; empty: no detail
};

/// Lens and pixel footprint: from the radiance of the scene to that of each pixel. A plain Gaussian, as published, acts
/// along rows and columns (gaussian_psf()); a physical point spread is round (round_kernel()).
class Optics {
 public:
  Optics(const OpticsParameters& optics, const SpectralResponse& response, const PixelSampling& sampling);

  /// In place. A plain Gaussian ignores the detail.
  void apply(const SubpixelDetail& detail, Plane<float>& picture);

 private:
  std::variant<Convolution, RoundConvolution> convolution_;
};

}  // namespace thermal
