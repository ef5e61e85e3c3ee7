#include "imaging/sampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/clones.h"
#include "base/parallel.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

constexpr std::size_t kRowsPerChunk = 8;

/// Offsets from a pixel to its right and lower neighbours; 0 in a picture one pixel wide or high.
struct Steps {
  std::int32_t right = 0;
  std::int32_t down = 0;
};

template <typename T>
Steps steps_of(const Plane<T>& plane) noexcept {
  return {.right = plane.width_px() > 1 ? 1 : 0, .down = plane.height_px() > 1 ? plane.width_px() : 0};
}

/// a + share * (b - a) instead of a weighted sum, so that uniform areas stay exactly uniform.
VELDT_CLONES void interpolate(const float* __restrict in, Steps steps, const std::int32_t* __restrict corner,
                              const float* __restrict x_share, const float* __restrict y_share,
                              float* __restrict out, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const float* at = in + corner[i];
    const float upper = at[0] + x_share[i] * (at[steps.right] - at[0]);
    const float left_below = at[steps.down];
    const float lower = left_below + x_share[i] * (at[steps.down + steps.right] - left_below);
    out[i] = upper + y_share[i] * (lower - upper);
  }
}

/// Splits a position into the last pixel at or before it that has a successor, and the fraction beyond it.
std::pair<int, float> split(double place_px, int size_px) noexcept {
  const double inside_px = std::clamp(place_px, 0.0, size_px - 1.0);
  const int first = std::min(static_cast<int>(inside_px), std::max(size_px - 2, 0));
  return {first, static_cast<float>(inside_px - first)};
}

}  // namespace

ResampleMap::ResampleMap(const CameraIntrinsics& camera, int overscan_px, const LensDistortion& lens)
    : width_px_(camera.width_px), height_px_(camera.height_px), overscan_px_(overscan_px) {
  assert(overscan_px >= thermal::overscan_px(camera, lens));
  if (lens.is_none()) return;
  const auto pixels = static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
  corner_.resize(pixels);
  x_share_.resize(pixels);
  y_share_.resize(pixels);
  parallel_rows(height_px_, kRowsPerChunk, [&](int y) { place_row(camera, lens, y); });
}

void ResampleMap::place_row(const CameraIntrinsics& camera, const LensDistortion& lens, int y) {
  const int wide_px = width_px_ + 2 * overscan_px_;
  const int high_px = height_px_ + 2 * overscan_px_;
  std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_);
  for (int x = 0; x < width_px_; ++x, ++i) {
    const LensPoint seen = unproject(camera, lens, {x + 0.5, y + 0.5});
    const double u_px = camera.fx_px * seen.x + camera.cx_px + overscan_px_;
    const double v_px = camera.fy_px * seen.y + camera.cy_px + overscan_px_;
    const auto [column, x_share] = split(u_px - 0.5, wide_px);
    const auto [row, y_share] = split(v_px - 0.5, high_px);
    corner_[i] = row * wide_px + column;
    x_share_[i] = x_share;
    y_share_[i] = y_share;
  }
}

template <typename T>
void ResampleMap::crop(const Plane<T>& in, Plane<T>& out) const {
  for (int y = 0; y < height_px_; ++y) {
    const auto row =
        in.row(y + overscan_px_).subspan(static_cast<std::size_t>(overscan_px_), out.row(y).size());
    std::copy(row.begin(), row.end(), out.row(y).begin());
  }
}

void ResampleMap::resample_linear(const Plane<float>& in, Plane<float>& out) const {
  assert(in.width_px() == width_px_ + 2 * overscan_px_ && in.height_px() == height_px_ + 2 * overscan_px_);
  out.resize(width_px_, height_px_);
  if (corner_.empty()) return crop(in, out);
  const Steps steps = steps_of(in);
  const auto width = static_cast<std::size_t>(width_px_);
  parallel_rows(height_px_, kRowsPerChunk, [&](int y) {
    const std::size_t begin = static_cast<std::size_t>(y) * width;
    interpolate(in.pixels().data(), steps, &corner_[begin], &x_share_[begin], &y_share_[begin],
                out.row(y).data(), width);
  });
}

Plane<std::uint16_t> ResampleMap::resample_nearest(const Plane<std::uint16_t>& in) const {
  assert(in.width_px() == width_px_ + 2 * overscan_px_ && in.height_px() == height_px_ + 2 * overscan_px_);
  Plane<std::uint16_t> out(width_px_, height_px_);
  if (corner_.empty()) {
    crop(in, out);
    return out;
  }
  const auto width = static_cast<std::size_t>(width_px_);
  parallel_rows(height_px_, kRowsPerChunk, [&](int y) {
    const std::size_t begin = static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x)
      out.at(static_cast<int>(x), y) = in.pixels()[nearest(begin + x, in)];
  });
  return out;
}

std::size_t ResampleMap::nearest(std::size_t pixel, const Plane<std::uint16_t>& in) const noexcept {
  const Steps steps = steps_of(in);
  const std::int32_t across = x_share_[pixel] < 0.5F ? 0 : steps.right;
  const std::int32_t down = y_share_[pixel] < 0.5F ? 0 : steps.down;
  return static_cast<std::size_t>(corner_[pixel] + across + down);
}

Plane<std::uint16_t> ResampleMap::times_shown() const {
  Plane<std::uint16_t> times(width_px_ + 2 * overscan_px_, height_px_ + 2 * overscan_px_);
  for (std::size_t i = 0; i < corner_.size(); ++i) ++times.pixels()[nearest(i, times)];
  for (int y = 0; corner_.empty() && y < height_px_; ++y) {
    for (int x = 0; x < width_px_; ++x) times.at(x + overscan_px_, y + overscan_px_) = 1;
  }
  return times;
}

namespace {

/// The blocks that overlap a box of fine pixels.
PixelBox blocks_of(const PixelBox& fine, int factor) {
  const int left = fine.x_px / factor;
  const int top = fine.y_px / factor;
  const int right = (fine.x_px + fine.width_px - 1) / factor;
  const int bottom = (fine.y_px + fine.height_px - 1) / factor;
  return {left, top, right - left + 1, bottom - top + 1};
}

int pixels_in_block(const Plane<std::uint16_t>& fine, int factor, int x, int y, std::uint16_t index) {
  int pixels = 0;
  for (int row = y * factor; row < (y + 1) * factor; ++row) {
    for (int column = x * factor; column < (x + 1) * factor; ++column)
      pixels += fine.at(column, row) == index;
  }
  return pixels;
}

}  // namespace

Plane<float> block_means(const Plane<float>& fine, int factor) {
  assert(factor >= 1 && fine.width_px() % factor == 0 && fine.height_px() % factor == 0);
  Plane<float> coarse(fine.width_px() / factor, fine.height_px() / factor);
  const float share = 1.0F / static_cast<float>(factor * factor);
  for (int y = 0; y < fine.height_px(); ++y) {
    const auto in = fine.row(y);
    const auto out = coarse.row(y / factor);
    for (std::size_t x = 0; x < in.size(); ++x) out[x / static_cast<std::size_t>(factor)] += in[x];
  }
  for (float& value : coarse.pixels()) value *= share;
  return coarse;
}

Plane<std::uint16_t> block_actors(const Plane<std::uint16_t>& fine, int factor,
                                  std::span<const IndexUse> uses, const IndexSet& actors) {
  Plane<std::uint16_t> coarse(fine.width_px() / factor, fine.height_px() / factor);
  for (const IndexUse& use : uses) {
    if (!actors.contains(use.index)) continue;
    const PixelBox blocks = blocks_of(use.box, factor);
    for (int y = blocks.y_px; y < blocks.y_px + blocks.height_px; ++y) {
      for (int x = blocks.x_px; x < blocks.x_px + blocks.width_px; ++x) {
        const bool covered = 2 * pixels_in_block(fine, factor, x, y, use.index) >= factor * factor;
        if (covered && coarse.at(x, y) == 0) coarse.at(x, y) = use.index;
      }
    }
  }
  return coarse;
}

namespace {

constexpr std::size_t kQuarterRowsPerChunk = 16;

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
  parallel_for(rows, kQuarterRowsPerChunk, [&](std::size_t begin, std::size_t end) {
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
