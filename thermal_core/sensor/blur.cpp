#include "sensor/blur.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kRowsAChunk = 16;

/// Weights of offsets 0, 1, …, radius; with the mirrored half they sum to 1.
std::vector<float> half_kernel(double sigma_px) {
  const auto radius = static_cast<int>(std::ceil(4 * sigma_px));
  std::vector<double> weights;
  double sum = 0;
  for (int offset = 0; offset <= radius; ++offset) {
    weights.push_back(std::exp(-0.5 * offset * offset / (sigma_px * sigma_px)));
    sum += (offset == 0 ? 1 : 2) * weights.back();
  }
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

/// Index inside [0, size) that a mirrored picture shows at `at`.
int mirrored(int at, int size) {
  const int period = 2 * size;
  const int wrapped = ((at % period) + period) % period;
  return wrapped < size ? wrapped : period - 1 - wrapped;
}

void blur_row(std::span<const float> row, const std::vector<float>& kernel, std::vector<float>& padded,
              std::span<float> out) {
  const std::size_t radius = kernel.size() - 1;
  const auto width = static_cast<int>(row.size());
  padded.resize(row.size() + 2 * radius);
  for (std::size_t i = 0; i < padded.size(); ++i) {
    padded[i] =
        row[static_cast<std::size_t>(mirrored(static_cast<int>(i) - static_cast<int>(radius), width))];
  }
  const float* centre = padded.data() + radius;
  for (std::size_t x = 0; x < row.size(); ++x) out[x] = kernel[0] * centre[x];
  for (std::size_t offset = 1; offset <= radius; ++offset) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      out[x] += kernel[offset] * (centre[x + offset] + *(centre + x - offset));
    }
  }
}

void blur_column(const Plane<float>& picture, int y, const std::vector<float>& kernel, std::span<float> out) {
  const auto middle = picture.row(y);
  for (std::size_t x = 0; x < out.size(); ++x) out[x] = kernel[0] * middle[x];
  for (int offset = 1; offset < static_cast<int>(kernel.size()); ++offset) {
    const auto above = picture.row(mirrored(y - offset, picture.height_px()));
    const auto below = picture.row(mirrored(y + offset, picture.height_px()));
    const float weight = kernel[static_cast<std::size_t>(offset)];
    for (std::size_t x = 0; x < out.size(); ++x) out[x] += weight * (above[x] + below[x]);
  }
}

}  // namespace

Plane<float> gaussian_blur(const Plane<float>& picture, double sigma_px) {
  assert(sigma_px >= 0 && std::isfinite(sigma_px));
  if (sigma_px == 0 || picture.empty()) return picture;
  const std::vector<float> kernel = half_kernel(sigma_px);
  const auto rows = static_cast<std::size_t>(picture.height_px());
  Plane<float> across(picture.width_px(), picture.height_px());
  parallel_for(rows, kRowsAChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<float> padded;
    for (std::size_t y = begin; y < end; ++y) {
      blur_row(picture.row(static_cast<int>(y)), kernel, padded, across.row(static_cast<int>(y)));
    }
  });
  Plane<float> blurred(picture.width_px(), picture.height_px());
  parallel_for(rows, kRowsAChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      blur_column(across, static_cast<int>(y), kernel, blurred.row(static_cast<int>(y)));
    }
  });
  return blurred;
}

}  // namespace thermal
