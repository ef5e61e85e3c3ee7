#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "io/files.h"
#include "io/png_header.h"
#include "scene/manifest.h"

namespace thermal {

/// What a PNG tells of its colours beside its pixels.
struct PngColours {
  std::vector<Colour> palette;
  std::vector<std::uint8_t> alphas;  ///< of the palette's first entries
  std::optional<std::array<std::uint16_t, 3>>
      clear;  ///< samples of the one colour that is transparent; grey: the first
};

/// A PNG that is read by libpng: its head first, so that a claim can be judged before memory is taken for it.
/// Faults of the file are DataErrors without its name, "damaged: " and libpng's words; libpng itself prints nothing.
/// Chunks that a reader may leave out are left out, whatever length they claim; their sums are checked all the same.
class PngFile {
 public:
  /// Reads up to the pixels. DataError if it is no PNG, or damaged as far as that; IoError, which names it, if it cannot
  /// be read.
  explicit PngFile(const Path& file);
  ~PngFile();
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  [[nodiscard]] const PngHeader& header() const noexcept;
  [[nodiscard]] PngColours colours() const;

  /// What is done with each row, from the top. Samples as they are stored (no gamma, no premultiplication, no palette
  /// looked up): a byte each, of 16 bits two in this machine's order.
  using TakeSamples = std::function<void(int y, std::span<const std::uint8_t> row)>;

  /// Reads the pixels and on to the file's end; once. Holds a row, the whole picture if it is interlaced.
  /// DataError for what is not whole; rows may have been taken by then.
  void read(const TakeSamples& take);

 private:
  class Reading;
  std::unique_ptr<Reading> reading_;
};

}  // namespace thermal
