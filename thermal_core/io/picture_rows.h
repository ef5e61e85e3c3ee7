#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "io/png_file.h"
#include "scene/manifest.h"

namespace thermal {

/// Meaning of the pixels of a picture.
enum class PictureKind { grey8, grey16, colour };

/// One pixel of a picture: a number, or a colour with 8 bits per channel. Alpha is 255 if opaque, 65535 in 16-bit
/// pictures.
struct PicturePixel {
  std::uint16_t grey = 0;
  Colour colour{};
  std::uint16_t alpha = 0;
};

/// The kind of a picture with this header. DataError (without the file's name) for colours with 16 bits per channel.
[[nodiscard]] PictureKind kind_of(const PngHeader& header);

/// Called with each row, from the top.
using TakeRow = std::function<void(int y, std::span<const PicturePixel> row)>;

/// Reads the samples of a PNG as stored: no gamma, no premultiplication; palettes are looked up. DataError "damaged:
/// …" (without the file's name) if it is incomplete; some rows may have been delivered by then.
void read_rows(PngFile& file, const TakeRow& take);

}  // namespace thermal
