#include "sensor/processing.h"

#include "base/clones.h"
#include "base/parallel.h"
#include "sensor/psf.h"

namespace thermal {
namespace {

constexpr std::size_t kProcessedPixelsAChunk = 16384;

VELDT_CLONES void to_floats(const std::uint16_t* in, std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(static_cast<std::int32_t>(in[i]));
}

VELDT_CLONES void mask(const float* sharp, const float* blurred, float amount, const std::uint16_t* in,
                       std::size_t count, std::uint16_t* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float value = sharp[i] + amount * (sharp[i] - blurred[i]) + 0.5F;
    const float above = value > 1 ? value : 1;
    const float within = above < 65534 ? above : 65534;
    const bool is_measured = in[i] != 0 && in[i] != 65535;
    out[i] = static_cast<std::uint16_t>(is_measured ? static_cast<std::int32_t>(within)
                                                    : static_cast<std::int32_t>(in[i]));
  }
}

}  // namespace

Processing::Processing(const ProcessingParameters& parameters)
    : unsharp_amount_(static_cast<float>(parameters.unsharp_amount)),
      noise_filter_(gaussian_psf(parameters.noise_filter_sigma_px)),
      unsharp_(gaussian_psf(parameters.unsharp_sigma_px)) {}

const Plane<std::uint16_t>& Processing::filter(const Plane<std::uint16_t>& ir16) {
  const bool is_sharpened = unsharp_amount_ > 0;
  if (!is_sharpened && noise_filter_.kernel().size() == 1) return ir16;
  sharp_.resize(ir16.width_px(), ir16.height_px());
  filtered_.resize(ir16.width_px(), ir16.height_px());
  const auto in = ir16.pixels();
  const auto sharp = sharp_.pixels();
  const auto out = filtered_.pixels();
  parallel_for(in.size(), kProcessedPixelsAChunk, [&](std::size_t begin, std::size_t end) {
    to_floats(&in[begin], end - begin, &sharp[begin]);
  });
  noise_filter_.apply(sharp_);
  blurred_ = sharp_;
  if (is_sharpened) unsharp_.apply(blurred_);
  const auto blurred = blurred_.pixels();
  parallel_for(in.size(), kProcessedPixelsAChunk, [&](std::size_t begin, std::size_t end) {
    mask(&sharp[begin], &blurred[begin], unsharp_amount_, &in[begin], end - begin, &out[begin]);
  });
  return filtered_;
}

}  // namespace thermal
