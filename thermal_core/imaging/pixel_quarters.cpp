#include "imaging/pixel_quarters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

constexpr std::size_t kQuarterRowsAChunk = 16;

bool is_resampled(const Manifest& manifest, const LensDistortion& lens) {
  return manifest.overscan_px > 0 || (!lens.is_none() && lens != manifest.lens);
}

void clear(int width_px, int height_px, Plane<float>& plane) {
  if (plane.width_px() == width_px && plane.height_px() == height_px) {
    std::ranges::fill(plane.pixels(), 0.0F);
  } else {
    plane = Plane<float>(width_px, height_px);
  }
}

/// Adds lines of samples into sums of `side` of them.
void add_lines(const Plane<float>& fine, int first_line, int side, std::vector<float>& sums) {
  std::ranges::fill(sums, 0.0F);
  for (int line = first_line; line < first_line + side; ++line) {
    const float* in = fine.row(line).data();
    for (float& sum : sums) {
      for (int k = 0; k < side; ++k) sum += in[k];
      in += side;
    }
  }
}

}  // namespace

PixelSampling pixel_sampling(const Manifest& manifest, const LensDistortion& lens) {
  return {.across = samples_across_pixel(manifest),
          .quarters =
              manifest.supersample % 2 == 0 && manifest.cryptomatte.empty() && !is_resampled(manifest, lens)};
}

void clear_detail(int width_px, int height_px, SubpixelDetail& detail) {
  for (Plane<float>* plane : {&detail.across, &detail.down, &detail.crossed})
    clear(width_px, height_px, *plane);
}

void set_detail(const std::array<float, 4>& quarters, int x, int y, SubpixelDetail& detail) noexcept {
  const auto [top_left, top_right, bottom_left, bottom_right] = quarters;
  const float across = 0.25F * ((top_right + bottom_right) - (top_left + bottom_left));
  const float down = 0.25F * ((bottom_left + bottom_right) - (top_left + top_right));
  const float crossed = 0.25F * ((top_left + bottom_right) - (top_right + bottom_left));
  if (!std::isfinite(across + down + crossed)) return;
  detail.across.at(x, y) = across;
  detail.down.at(x, y) = down;
  detail.crossed.at(x, y) = crossed;
}

QuarterSums::QuarterSums(const FineSamples& fine)
    : parts_(fine.factor % 2 == 0 ? 2 : 1), side_(static_cast<std::size_t>(fine.factor) / parts_) {}

void QuarterSums::begin(std::size_t pixels) {
  for (std::vector<float>& sums : sums_) sums.assign(parts_ * pixels, 0.0F);
}

void QuarterSums::add(int line, std::span<const float> samples) {
  std::vector<float>& sums = sums_.at(static_cast<std::size_t>(line) / side_);
  for (std::size_t i = 0; i < samples.size(); ++i) sums[i / side_] += samples[i];
}

float QuarterSums::mean(std::size_t pixel) const noexcept {
  if (parts_ == 1) return sums_.front()[pixel] / static_cast<float>(side_ * side_);
  const auto [top_left, top_right, bottom_left, bottom_right] = quarters(pixel);
  return 0.25F * ((top_left + top_right) + (bottom_left + bottom_right));
}

std::array<float, 4> QuarterSums::quarters(std::size_t pixel) const noexcept {
  const float share = 1.0F / static_cast<float>(side_ * side_);
  const std::size_t left = 2 * pixel;
  return {share * sums_[0][left], share * sums_[0][left + 1], share * sums_[1][left],
          share * sums_[1][left + 1]};
}

void mean_quarters(const Plane<float>& fine, int factor, Plane<float>& means, SubpixelDetail& detail) {
  assert(factor % 2 == 0 && fine.width_px() % factor == 0 && fine.height_px() % factor == 0);
  const int width = fine.width_px() / factor;
  const int height = fine.height_px() / factor;
  const int side = factor / 2;
  const float share = 1.0F / static_cast<float>(side * side);
  if (means.width_px() != width || means.height_px() != height) means = Plane<float>(width, height);
  clear_detail(width, height, detail);
  parallel_for(static_cast<std::size_t>(height), kQuarterRowsAChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<float> top(2 * static_cast<std::size_t>(width));
    std::vector<float> bottom(top.size());
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      add_lines(fine, y * factor, side, top);
      add_lines(fine, y * factor + side, side, bottom);
      for (int x = 0; x < width; ++x) {
        const std::size_t at = 2 * static_cast<std::size_t>(x);
        const std::array quarters = {share * top[at], share * top[at + 1], share * bottom[at],
                                     share * bottom[at + 1]};
        means.at(x, y) = 0.25F * ((quarters[0] + quarters[1]) + (quarters[2] + quarters[3]));
        set_detail(quarters, x, y, detail);
      }
    }
  });
}

}  // namespace thermal
