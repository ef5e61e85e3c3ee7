#include "imaging/resample.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kRowsAChunk = 8;

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
  parallel_rows(height_px_, kRowsAChunk, [&](int y) { place_row(camera, lens, y); });
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
  parallel_rows(height_px_, kRowsAChunk, [&](int y) {
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
  parallel_rows(height_px_, kRowsAChunk, [&](int y) {
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

}  // namespace thermal
