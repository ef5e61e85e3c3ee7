#include "imaging/supersample.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "scene/manifest.h"

namespace thermal {

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
                                  std::span<const std::uint16_t> actor_indices) {
  std::vector<bool> is_actor(kLargestIndex + 1);
  for (const std::uint16_t index : actor_indices) is_actor[index] = true;
  Plane<std::uint16_t> coarse(fine.width_px() / factor, fine.height_px() / factor);
  std::vector<std::uint16_t> block;
  for (int y = 0; y < coarse.height_px(); ++y) {
    for (int x = 0; x < coarse.width_px(); ++x) {
      block.clear();
      for (int i = 0; i < factor * factor; ++i) {
        const std::uint16_t index = fine.at(x * factor + i % factor, y * factor + i / factor);
        if (is_actor[index]) block.push_back(index);
      }
      if (2 * static_cast<int>(block.size()) < factor * factor) continue;
      std::sort(block.begin(), block.end());
      for (auto run = block.begin(); run != block.end();) {
        const auto end = std::upper_bound(run, block.end(), *run);
        if (2 * (end - run) >= factor * factor) {
          coarse.at(x, y) = *run;
          break;
        }
        run = end;
      }
    }
  }
  return coarse;
}

}  // namespace thermal
