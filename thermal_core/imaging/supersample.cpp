#include "imaging/supersample.h"

#include <algorithm>
#include <cassert>

namespace thermal {
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

}  // namespace thermal
