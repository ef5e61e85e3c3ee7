#pragma once

#include <variant>

#include "base/image.h"
#include "radiometry/spectral_response.h"
#include "sensor/convolution.h"
#include "sensor/round_convolution.h"
#include "sensor/round_kernel.h"
#include "sensor/sensor_parameters.h"
#include "sensor/subpixel_detail.h"

namespace thermal {

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
