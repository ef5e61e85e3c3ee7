#include "io/png_header.h"

#include <limits>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {

std::size_t PngHeader::channels() const noexcept {
  return (colour && !palette ? 3U : 1U) + (alpha ? 1U : 0U);
}

std::int64_t PngHeader::raw_bytes() const noexcept {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const std::int64_t bits_a_pixel = static_cast<std::int64_t>(channels()) * bit_depth;
  const std::int64_t row_bytes = (std::int64_t{width_px} * bits_a_pixel + 7) / 8;
  return row_bytes <= kMost / height_px ? row_bytes * height_px : kMost;
}

void check_plausible(const PngHeader& header, std::int64_t most_pixels) {
  // Deflate makes at best 258 bytes from 2 bits; a far larger claim is not a real picture.
  constexpr std::int64_t kMostRatio = 1032;
  const std::int64_t width = header.width_px;
  if (width > most_pixels || header.height_px > most_pixels / width) {
    throw DataError(fault("size", fmt::format("{} x {}", header.width_px, header.height_px), "px",
                          fmt::format("at most {} pixels", most_pixels)));
  }
  if (header.raw_bytes() / kMostRatio <= header.file_bytes) return;
  throw DataError(fault("pixels", fmt::format("{}", header.raw_bytes()), "bytes",
                        fmt::format("what a file of {} bytes can hold", header.file_bytes)));
}

}  // namespace thermal
