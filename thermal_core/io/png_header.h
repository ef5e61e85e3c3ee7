#pragma once

#include <cstddef>
#include <cstdint>

namespace thermal {

/// Claims of a PNG's header.
struct PngHeader {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  int bit_depth = 0;  ///< of a sample, or of a palette index
  bool palette = false;
  bool colour = false;  ///< palettes too
  bool alpha = false;   ///< a channel of it
  std::int64_t file_bytes = 0;

  /// As stored: one with a palette.
  [[nodiscard]] std::size_t channels() const noexcept;
  /// Of all pixels before compression, saturated.
  [[nodiscard]] std::int64_t raw_bytes() const noexcept;
};

/// DataError (without the file's name) for a picture of more than `most_pixels`, or of more than its file can hold.
void check_plausible(const PngHeader& header, std::int64_t most_pixels);

}  // namespace thermal
