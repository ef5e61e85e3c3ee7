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

}  // namespace

PixelSampling pixel_sampling(const Manifest& manifest, const LensDistortion& lens) {
  return {.across = samples_across_pixel(manifest),
          .quarters =
              manifest.supersample % 2 == 0 && manifest.cryptomatte.empty() && !is_resampled(manifest, lens)};
}

void clear_detail(int width_px, int height_px, SubpixelDetail& detail) {
  for (Plane<float>* plane : {&detail.across, &detail.down, &detail.crossed}) {
    plane->resize(width_px, height_px);
    std::ranges::fill(plane->pixels(), 0.0F);
  }
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

QuarterSums::QuarterSums(int factor)
    : parts_(factor % 2 == 0 ? 2 : 1), side_(static_cast<std::size_t>(factor) / parts_) {}

void QuarterSums::begin(std::size_t pixels) {
  for (std::vector<float>& sums : sums_) sums.assign(parts_ * pixels, 0.0F);
}

void QuarterSums::add(int line, std::span<const float> samples) {
  const float* in = samples.data();
  for (float& sum : sums_.at(static_cast<std::size_t>(line) / side_)) {
    for (std::size_t k = 0; k < side_; ++k) sum += in[k];
    in += side_;
  }
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
  means.resize(fine.width_px() / factor, fine.height_px() / factor);
  clear_detail(means.width_px(), means.height_px(), detail);
  const auto rows = static_cast<std::size_t>(means.height_px());
  parallel_for(rows, kQuarterRowsAChunk, [&](std::size_t begin, std::size_t end) {
    QuarterSums sums(factor);
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      sums.begin(means.row(y).size());
      for (int line = 0; line < factor; ++line) sums.add(line, fine.row(y * factor + line));
      for (int x = 0; x < means.width_px(); ++x) {
        means.at(x, y) = sums.mean(static_cast<std::size_t>(x));
        set_detail(sums.quarters(static_cast<std::size_t>(x)), x, y, detail);
      }
    }
  });
}

}  // namespace thermal
