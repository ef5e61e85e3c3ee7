#include "sensor/processing.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "base/clones.h"
#include "base/parallel.h"
#include "sensor/psf.h"

namespace thermal {
namespace {

constexpr std::size_t kProcessedRowsAChunk = 32;

VELDT_CLONES void set_counts(const std::uint16_t* in, std::size_t size, float weight, float* out) {
  for (std::size_t i = 0; i < size; ++i)
    out[i] = weight * static_cast<float>(static_cast<std::int32_t>(in[i]));
}

VELDT_CLONES void add_pairs_of_counts(const std::uint16_t* one, const std::uint16_t* other, std::size_t size,
                                      float weight, float* out) {
  for (std::size_t i = 0; i < size; ++i) {
    const std::int32_t sum = static_cast<std::int32_t>(one[i]) + static_cast<std::int32_t>(other[i]);
    out[i] += weight * static_cast<float>(sum);
  }
}

/// A row convolved along columns, mirrored at the borders.
void convolve_columns(const Plane<std::uint16_t>& ir16, int y, const HalfKernel& kernel,
                      std::vector<float>& out) {
  set_counts(ir16.row(y).data(), out.size(), kernel[0], out.data());
  for (int offset = 1; offset < static_cast<int>(kernel.size()); ++offset)
    add_pairs_of_counts(ir16.row(mirrored(y - offset, ir16.height_px())).data(),
                        ir16.row(mirrored(y + offset, ir16.height_px())).data(), out.size(),
                        kernel[static_cast<std::size_t>(offset)], out.data());
}

/// Both kernels in sequence.
HalfKernel convolved(const HalfKernel& one, const HalfKernel& other) {
  const auto reach = static_cast<int>(one.size()) - 1;
  const auto others = static_cast<int>(other.size());
  std::vector<double> weights(one.size() + other.size() - 1);
  for (int at = 0; at < static_cast<int>(weights.size()); ++at) {
    for (int from = std::max(-reach, at - others + 1); from <= std::min(reach, at + others - 1); ++from)
      weights[static_cast<std::size_t>(at)] +=
          static_cast<double>(one[static_cast<std::size_t>(std::abs(from))]) *
          static_cast<double>(other[static_cast<std::size_t>(std::abs(at - from))]);
  }
  return rounded_kernel(weights);
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
      noise_filter_(gaussian_psf(parameters.noise_filter_sigma_px)) {
  if (unsharp_amount_ > 0) blur_ = convolved(noise_filter_, gaussian_psf(parameters.unsharp_sigma_px));
}

const Plane<std::uint16_t>& Processing::filter(const Plane<std::uint16_t>& ir16) {
  if (blur_.empty() && noise_filter_.size() == 1) return ir16;
  filtered_.resize(ir16.width_px(), ir16.height_px());
  parallel_rows(ir16.height_px(), kProcessedRowsAChunk, [&](int y) {
    std::vector<float> down(static_cast<std::size_t>(ir16.width_px()));
    std::vector<float> padded;
    const auto blur = [&](const HalfKernel& kernel) {
      std::vector<float> out(down.size());
      convolve_columns(ir16, y, kernel, down);
      convolve_row(down, kernel, padded, out);
      return out;
    };
    const std::vector<float> sharp = blur(noise_filter_);
    std::vector<float> blurred;
    if (!blur_.empty()) blurred = blur(blur_);
    mask(sharp.data(), blur_.empty() ? sharp.data() : blurred.data(), unsharp_amount_, ir16.row(y).data(),
         sharp.size(), filtered_.row(y).data());
  });
  return filtered_;
}

}  // namespace thermal
