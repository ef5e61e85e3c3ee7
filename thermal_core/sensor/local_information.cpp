#include "sensor/local_information.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kMarkedRowsAChunk = 32;

VELDT_INLINE std::int32_t size_of(std::int32_t difference) {
  return difference < 0 ? -difference : difference;
}

/// One row, from columns `begin` to `end`, whose neighbours are `left` and `right` columns away.
VELDT_CLONES void mark_columns(const std::uint16_t* up, const std::uint16_t* here, const std::uint16_t* down,
                               std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t left,
                               std::ptrdiff_t right, std::int32_t threshold, std::uint8_t* marks) {
  for (std::ptrdiff_t x = begin; x < end; ++x) {
    const std::int32_t before = up[x - left] + here[x - left] + down[x - left];
    const std::int32_t after = up[x + right] + here[x + right] + down[x + right];
    const std::int32_t above = up[x - left] + up[x] + up[x + right];
    const std::int32_t below = down[x - left] + down[x] + down[x + right];
    const std::int32_t across = size_of(after - before);
    const std::int32_t along = size_of(below - above);
    marks[x] = static_cast<std::uint8_t>((across > along ? across : along) > threshold);
  }
}

void mark_row(const Plane<std::uint16_t>& ir16, int y, std::int32_t threshold, std::uint8_t* marks) {
  const std::uint16_t* const up = ir16.row(std::max(y - 1, 0)).data();
  const std::uint16_t* const here = ir16.row(y).data();
  const std::uint16_t* const down = ir16.row(std::min(y + 1, ir16.height_px() - 1)).data();
  const std::ptrdiff_t width = ir16.width_px();
  const std::ptrdiff_t last = width - 1;
  mark_columns(up, here, down, 0, 1, 0, last > 0 ? 1 : 0, threshold, marks);
  if (last > 0) mark_columns(up, here, down, last, width, 1, 0, threshold, marks);
  mark_columns(up, here, down, 1, last, 1, 1, threshold, marks);
}

}  // namespace

void mark_information(const Plane<std::uint16_t>& ir16, double threshold_counts, Plane<std::uint8_t>& marks) {
  marks.resize(ir16.width_px(), ir16.height_px());
  constexpr double kLargestSum = 3 * 65535;
  const auto threshold = static_cast<std::int32_t>(std::min(kLargestSum, std::floor(3 * threshold_counts)));
  parallel_rows(ir16.height_px(), kMarkedRowsAChunk,
                [&](int y) { mark_row(ir16, y, threshold, marks.row(y).data()); });
}

}  // namespace thermal
