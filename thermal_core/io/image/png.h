#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
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

/// A grey PNG in memory; lossless. Every row is filtered with PNG's filter "sub" and compressed by ISA-L at level 3:
/// on noisy pictures as small as zlib's, in a third of the time (DECISIONS.md, "PNG by ISA-L at level 3"). The bytes
/// depend on the picture, on ISA-L's version, and possibly on the processor, for which ISA-L has specific code. The
/// picture must not be empty. `out` is overwritten; its memory is reused.
void encode_png(const Plane<std::uint8_t>& picture, std::vector<std::byte>& out);
/// The same with 16 bits.
void encode_png(const Plane<std::uint16_t>& picture, std::vector<std::byte>& out);

/// The same for one picture.
[[nodiscard]] std::vector<std::byte> encode_png(const Plane<std::uint8_t>& picture);
/// The same with 16 bits.
[[nodiscard]] std::vector<std::byte> encode_png(const Plane<std::uint16_t>& picture);

/// Reads a grey PNG with 8 or 16 bits, at most 256 million pixels; DataError with the file if it is another kind or
/// damaged, IoError if it cannot be read.
[[nodiscard]] Plane<std::uint8_t> read_png8(const Path& file);
/// The same with 16 bits.
[[nodiscard]] Plane<std::uint16_t> read_png16(const Path& file);

}  // namespace thermal
