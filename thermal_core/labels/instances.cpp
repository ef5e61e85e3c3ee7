#include "labels/instances.h"

#include <algorithm>
#include <cassert>

namespace thermal {
namespace {

constexpr std::size_t kIndices = 32768;

/// Extent of one index while a plane is scanned.
struct Extent {
  std::uint32_t pixels = 0;
  int first_x = 0;
  int first_y = 0;
  int left = 0;
  int right = 0;
  int bottom = 0;
};

/// Counts a run of equal indices, columns [begin, end) of row y.
void add_run(Extent& extent, int begin, int end, int y) {
  if (extent.pixels == 0) extent = {0, begin, y, begin, end, y};
  extent.pixels += static_cast<std::uint32_t>(end - begin);
  extent.left = std::min(extent.left, begin);
  extent.right = std::max(extent.right, end);
  extent.bottom = y;
}

/// Column-major run lengths of the pixels with this index; all of them are inside `box`.
RunLengths mask_of(const Plane<std::uint16_t>& plane, std::uint16_t index, const PixelBox& box) {
  RunLengths counts;
  const auto height = static_cast<std::size_t>(plane.height_px());
  std::size_t run_begin = 0;
  bool inside = false;
  for (int x = box.x_px; x < box.x_px + box.width_px; ++x) {
    for (int y = box.y_px; y <= box.y_px + box.height_px; ++y) {
      // One row past the box ends a column's run, unless box and frame are equally high: then the next column
      // carries the run on.
      const bool past = y == box.y_px + box.height_px;
      if (past && box.height_px == plane.height_px()) break;
      const bool set = !past && plane.at(x, y) == index;
      if (set == inside) continue;
      const std::size_t here = static_cast<std::size_t>(x) * height + static_cast<std::size_t>(y);
      counts.push_back(static_cast<std::uint32_t>(here - run_begin));
      run_begin = here;
      inside = set;
    }
  }
  if (inside) {  // the last column's run ends at the foot of the frame
    const std::size_t end = static_cast<std::size_t>(box.x_px + box.width_px) * height;
    counts.push_back(static_cast<std::uint32_t>(end - run_begin));
    run_begin = end;
  }
  const auto rest = static_cast<std::uint32_t>(plane.size() - run_begin);
  if (rest > 0) counts.push_back(rest);
  return counts;
}

bool touches_border(const PixelBox& box, const Plane<std::uint16_t>& plane) {
  return box.x_px == 0 || box.y_px == 0 || box.x_px + box.width_px == plane.width_px() ||
         box.y_px + box.height_px == plane.height_px();
}

}  // namespace

std::vector<IndexUse> survey_indices(const Plane<std::uint16_t>& index_plane) {
  std::vector<Extent> extents(kIndices);
  for (int y = 0; y < index_plane.height_px(); ++y) {
    const auto row = index_plane.row(y);
    for (std::size_t begin = 0; begin < row.size();) {
      const std::uint16_t index = row[begin];
      assert(index < kIndices);
      std::size_t end = begin + 1;
      while (end < row.size() && row[end] == index) ++end;
      add_run(extents[index], static_cast<int>(begin), static_cast<int>(end), y);
      begin = end;
    }
  }
  std::vector<IndexUse> uses;
  for (std::size_t index = 0; index < kIndices; ++index) {
    const Extent& e = extents[index];
    if (e.pixels == 0) continue;
    uses.push_back({.index = static_cast<std::uint16_t>(index),
                    .first_x_px = e.first_x,
                    .first_y_px = e.first_y,
                    .pixels = e.pixels,
                    .box = {e.left, e.first_y, e.right - e.left, e.bottom - e.first_y + 1}});
  }
  return uses;
}

std::vector<Instance> extract_instances(const Plane<std::uint16_t>& index_plane,
                                        std::span<const IndexUse> uses,
                                        std::span<const std::uint16_t> actor_indices) {
  std::vector<Instance> instances;
  for (const IndexUse& use : uses) {
    if (std::find(actor_indices.begin(), actor_indices.end(), use.index) == actor_indices.end()) continue;
    instances.push_back({.index = use.index,
                         .box = use.box,
                         .area_px = use.pixels,
                         .truncated = touches_border(use.box, index_plane),
                         .mask = mask_of(index_plane, use.index, use.box)});
  }
  return instances;
}

}  // namespace thermal
