#include "labels/surroundings.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace thermal {
namespace {

/// Sum over pixels, and their number.
struct Sum {
  double value = 0;
  std::size_t pixels = 0;
};

/// Calls run(x, first y, end y) for each run of a mask's pixels, column by column.
template <typename Run>
void for_runs(const RunLengths& mask, int height_px, const Run& run) {
  const auto height = static_cast<std::size_t>(height_px);
  std::size_t at = 0;
  for (std::size_t i = 0; i < mask.size(); at += mask[i++]) {
    if (i % 2 == 0) continue;
    const std::size_t end = at + mask[i];
    for (std::size_t begin = at; begin < end;) {  // a run continues at the top of the next column
      const std::size_t column = begin / height;
      const std::size_t stop = std::min(end, (column + 1) * height);
      run(static_cast<int>(column), static_cast<int>(begin - column * height),
          static_cast<int>(stop - column * height));
      begin = stop;
    }
  }
}

Sum sum_over(const Plane<float>& picture, const RunLengths& mask) {
  Sum sum;
  for_runs(mask, picture.height_px(), [&](int x, int begin, int end) {
    for (int y = begin; y < end; ++y) sum.value += static_cast<double>(picture.at(x, y));
    sum.pixels += static_cast<std::size_t>(end - begin);
  });
  return sum;
}

/// 1 where there is no instance.
Plane<std::uint8_t> free_pixels(const Plane<float>& picture, std::span<const Instance> instances) {
  Plane<std::uint8_t> is_free(picture.width_px(), picture.height_px(), 1);
  for (const Instance& instance : instances) {
    for_runs(instance.mask, picture.height_px(), [&](int x, int begin, int end) {
      for (int y = begin; y < end; ++y) is_free.at(x, y) = 0;
    });
  }
  return is_free;
}

/// A box grown by this many pixels on every side, clipped to the picture.
PixelBox grown(const PixelBox& box, int by_px, const Plane<float>& picture) {
  const int left = std::max(0, box.x_px - by_px);
  const int top = std::max(0, box.y_px - by_px);
  const int right = std::min(picture.width_px(), box.x_px + box.width_px + by_px);
  const int bottom = std::min(picture.height_px(), box.y_px + box.height_px + by_px);
  return {left, top, right - left, bottom - top};
}

void add_free(const Plane<float>& picture, const Plane<std::uint8_t>& is_free, const PixelBox& box,
              Sum& sum) {
  for (int y = box.y_px; y < box.y_px + box.height_px; ++y) {
    for (int x = box.x_px; x < box.x_px + box.width_px; ++x) {
      if (is_free.at(x, y) == 0) continue;
      sum.value += static_cast<double>(picture.at(x, y));
      ++sum.pixels;
    }
  }
}

/// The parts above, below, left and right of the guarded box.
Sum sum_around(const Plane<float>& picture, const Plane<std::uint8_t>& is_free, const PixelBox& box) {
  const PixelBox inner = grown(box, kGuardPx, picture);
  const PixelBox outer = grown(box, kGuardPx + ring_px(box), picture);
  const int inner_right = inner.x_px + inner.width_px;
  const int inner_bottom = inner.y_px + inner.height_px;
  const int outer_right = outer.x_px + outer.width_px;
  const int outer_bottom = outer.y_px + outer.height_px;
  Sum sum;
  add_free(picture, is_free, {outer.x_px, outer.y_px, outer.width_px, inner.y_px - outer.y_px}, sum);
  add_free(picture, is_free, {outer.x_px, inner_bottom, outer.width_px, outer_bottom - inner_bottom}, sum);
  add_free(picture, is_free, {outer.x_px, inner.y_px, inner.x_px - outer.x_px, inner.height_px}, sum);
  add_free(picture, is_free, {inner_right, inner.y_px, outer_right - inner_right, inner.height_px}, sum);
  return sum;
}

}  // namespace

int ring_px(const PixelBox& box) noexcept {
  constexpr int kLeastPx = 4;
  return std::max(kLeastPx, (std::max(box.width_px, box.height_px) + 1) / 2);
}

std::vector<TargetMeans> target_means(const Plane<float>& picture, std::span<const Instance> instances) {
  std::vector<TargetMeans> means;
  if (instances.empty()) return means;
  const Plane<std::uint8_t> is_free = free_pixels(picture, instances);
  for (const Instance& instance : instances) {
    const Sum target = sum_over(picture, instance.mask);
    assert(target.pixels == instance.area_px);
    TargetMeans mean = {.target = target.value / static_cast<double>(target.pixels), .ring = {}};
    const Sum ring = sum_around(picture, is_free, instance.box);
    if (ring.pixels > 0) mean.ring = ring.value / static_cast<double>(ring.pixels);
    means.push_back(mean);
  }
  return means;
}

}  // namespace thermal
