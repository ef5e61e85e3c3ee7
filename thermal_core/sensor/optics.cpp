#include "sensor/optics.h"

#include "sensor/psf.h"

namespace thermal {
namespace {

std::variant<Convolution, RoundConvolution> convolution_of(const OpticsParameters& optics,
                                                           const SpectralResponse& response,
                                                           const PixelSampling& sampling) {
  if (optics.psf == Psf::gaussian) return Convolution(gaussian_psf(optics.blur_sigma_px));
  return RoundConvolution(round_kernel(optics, response, sampling));
}

}  // namespace

Optics::Optics(const OpticsParameters& optics, const SpectralResponse& response,
               const PixelSampling& sampling)
    : convolution_(convolution_of(optics, response, sampling)) {}

void Optics::apply(const SubpixelDetail& detail, Plane<float>& picture) {
  if (auto* const separable = std::get_if<Convolution>(&convolution_)) {
    separable->apply(picture);
  } else {
    std::get<RoundConvolution>(convolution_).apply(detail, picture);
  }
}

}  // namespace thermal
