#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "io/png_file.h"
#include "scene/manifest.h"

namespace thermal {

/// What the pixels of a picture are.
enum class PictureKind { grey8, grey16, colour };

/// One pixel of a picture: a number, or a colour of 8 bits a channel. Alpha is 255 where it is opaque, 65535 in pictures
/// of 16 bits.
struct PicturePixel {
  std::uint16_t grey = 0;
  Colour colour{};
  std::uint16_t alpha = 0;
};

/// The kind of a picture with this head. DataError (without the file's name) for colours of 16 bits a channel.
[[nodiscard]] PictureKind kind_of(const PngHeader& header);

/// What is done with each row, from the top.
using TakeRow = std::function<void(int y, std::span<const PicturePixel> row)>;

/// Reads the numbers that a PNG stores, as they are: no gamma, no premultiplication; colours of a palette are looked up.
/// DataError "damaged: …" (without the file's name) for what is not whole; rows may have been taken by then.
void read_rows(PngFile& file, const TakeRow& take);

}  // namespace thermal
