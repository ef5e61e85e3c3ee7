#include "sensor/optics/convolution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

constexpr std::size_t kRowsPerChunk = 16;

/// The row with `radius` mirrored pixels on either side.
void pad_row(std::span<const float> row, std::size_t radius, std::vector<float>& padded) {
  padded.resize(row.size() + 2 * radius);
  std::copy(row.begin(), row.end(), padded.begin() + static_cast<std::ptrdiff_t>(radius));
  const auto width = static_cast<int>(row.size());
  for (std::size_t i = 0; i < radius; ++i) {
    const auto left = static_cast<int>(i) - static_cast<int>(radius);
    padded[i] = row[static_cast<std::size_t>(mirrored(left, width))];
    padded[radius + row.size() + i] =
        row[static_cast<std::size_t>(mirrored(width + static_cast<int>(i), width))];
  }
}

void convolve_column(const Plane<float>& picture, int y, const HalfKernel& kernel, std::span<float> out) {
  set_scaled(picture.row(y), kernel[0], out);
  for (int offset = 1; offset < static_cast<int>(kernel.size()); ++offset) {
    const auto above = picture.row(mirrored(y - offset, picture.height_px()));
    const auto below = picture.row(mirrored(y + offset, picture.height_px()));
    add_sum(above, below, kernel[static_cast<std::size_t>(offset)], out);
  }
}

}  // namespace

int mirrored(int at, int size) noexcept {
  const int period = 2 * size;
  const int wrapped = ((at % period) + period) % period;
  return wrapped < size ? wrapped : period - 1 - wrapped;
}

HalfKernel rounded_kernel(const std::vector<double>& half_weights) {
  assert(!half_weights.empty());
  HalfKernel kernel;
  double beside = 0;
  for (const double weight : half_weights) kernel.push_back(static_cast<float>(weight));
  for (std::size_t i = 1; i < kernel.size(); ++i) beside += 2 * static_cast<double>(kernel[i]);
  kernel[0] = static_cast<float>(1 - beside);
  return kernel;
}

HalfKernel gaussian_kernel(double sigma_px) {
  assert(sigma_px >= 0 && std::isfinite(sigma_px));
  if (sigma_px == 0) return {1.0F};
  const auto radius = static_cast<int>(std::ceil(4 * sigma_px));
  std::vector<double> weights;
  double sum = 0;
  for (int offset = 0; offset <= radius; ++offset) {
    weights.push_back(std::exp(-0.5 * offset * offset / (sigma_px * sigma_px)));
    sum += (offset == 0 ? 1 : 2) * weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return rounded_kernel(weights);
}

void convolve_row(std::span<const float> row, const HalfKernel& kernel, std::vector<float>& padded,
                  std::span<float> out) {
  const std::size_t radius = kernel.size() - 1;
  pad_row(row, radius, padded);
  const auto from = [&](std::size_t first) {
    return std::span<const float>(padded).subspan(first, row.size());
  };
  set_scaled(from(radius), kernel[0], out);
  for (std::size_t offset = 1; offset <= radius; ++offset)
    add_sum(from(radius - offset), from(radius + offset), kernel[offset], out);
}

void Convolution::apply(Plane<float>& picture) {
  if (kernel_.size() == 1 || picture.empty()) return;
  across_.resize(picture.width_px(), picture.height_px());
  parallel_rows(picture.height_px(), kRowsPerChunk, [&](int y) {
    std::vector<float> padded;
    convolve_row(picture.row(y), kernel_, padded, across_.row(y));
  });
  parallel_rows(picture.height_px(), kRowsPerChunk,
                [&](int y) { convolve_column(across_, y, kernel_, picture.row(y)); });
}

}  // namespace thermal
