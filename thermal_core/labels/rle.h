#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// Lengths of alternating runs of zeros and ones, zeros first (possibly 0 long), in column-major order.
using RunLengths = std::vector<std::uint32_t>;

/// COCO's compressed run lengths: each count, from the fourth on as the difference to the count two before,
/// in groups of five bits, low group first, a continuation bit above them, offset 48 into ASCII.
[[nodiscard]] std::string encode_coco_rle(const RunLengths& counts);

/// Inverse of encode_coco_rle. DataError if it could not have written the string.
[[nodiscard]] RunLengths decode_coco_rle(std::string_view text);

/// Pixels that run lengths cover, zeros and ones.
[[nodiscard]] constexpr std::int64_t covered_px(const RunLengths& runs) noexcept {
  std::int64_t pixels = 0;
  for (const std::uint32_t run : runs) pixels += run;
  return pixels;
}

/// Calls take(x, y, height) for each vertical stretch of ones [px] in a picture of this height, which they cover.
template <typename Take>
void for_stretches(const RunLengths& runs, int height_px, const Take& take) {
  std::int64_t at = 0;
  bool inside = false;
  for (const std::uint32_t run : runs) {
    const std::int64_t end = at + run;
    while (inside && at < end) {
      const auto y = static_cast<int>(at % height_px);
      const auto stretch_px = static_cast<int>(std::min<std::int64_t>(end - at, height_px - y));
      take(static_cast<int>(at / height_px), y, stretch_px);
      at += stretch_px;
    }
    at = end;
    inside = !inside;
  }
}

/// The mask of polygons, each x, y, x, y, … in pixels, in a picture of this size: a pixel is in it if it is in one of
/// them. Equal to pycocotools' (`merge(frPyObjects(…))`) in each pixel: corners are rounded to fifths of a pixel; a
/// border goes from corner to corner in steps of a fifth along its longer axis; where it crosses the middle of a column
/// of pixels, the pixels below toggle between outside and inside. Runs cover the picture; parts outside it are cut off.
/// Polygons have an even number of coordinates, all within 1e8 px, and the picture at most 2^32 - 1 pixels. DataError
/// for borders that cross columns more than 4 million times.
[[nodiscard]] RunLengths mask_of_polygons(std::span<const std::vector<double>> polygons, int width_px,
                                          int height_px);

}  // namespace thermal
