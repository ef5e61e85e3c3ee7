#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "io/system/files.h"
#include "scene/manifest.h"

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

  /// Stored channels: one with a palette.
  [[nodiscard]] std::size_t channels() const noexcept;
  /// Bytes of all pixels before compression, saturated.
  [[nodiscard]] std::int64_t raw_bytes() const noexcept;
};

/// DataError (without the file's name) for a picture of more than `most_pixels`, or of more than its file can hold.
void check_plausible(const PngHeader& header, std::int64_t most_pixels);

/// Colour information of a PNG besides its pixels.
struct PngColours {
  std::vector<Colour> palette;
  std::vector<std::uint8_t> alphas;  ///< of the palette's first entries
  std::optional<std::array<std::uint16_t, 3>>
      clear;  ///< samples of the one transparent colour; grey: the first
};

/// A PNG read by libpng: its header first, so that its claims can be checked before memory is allocated. Faults of
/// the file are DataErrors without its name, "damaged: " and libpng's message; libpng itself prints nothing.
/// Ancillary chunks are skipped, whatever length they claim; their checksums are still verified.
class PngFile {
 public:
  /// Reads up to the pixels. DataError if it is not a PNG, or damaged up to there; IoError with the file's name if it
  /// cannot be read.
  explicit PngFile(const Path& file);
  ~PngFile();
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  [[nodiscard]] const PngHeader& header() const noexcept;
  [[nodiscard]] PngColours colours() const;

  /// Called with each row, from the top. Samples as stored (no gamma, no premultiplication, no palette look-up): one
  /// byte each, of 16 bits two in this machine's order.
  using TakeSamples = std::function<void(int y, std::span<const std::uint8_t> row)>;

  /// Reads the pixels, to the file's end; call once. Memory for one row, or the whole picture if it is interlaced.
  /// DataError if it is incomplete; some rows may have been delivered by then.
  void read(const TakeSamples& take);

 private:
  class Reading;
  std::unique_ptr<Reading> reading_;
};

}  // namespace thermal
