#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "io/files.h"

namespace thermal {

/// A grey PNG in memory; lossless. Every row goes through PNG's filter "sub" and is compressed by ISA-L at level 3: with
/// noise in the picture as small as by zlib, in a quarter of the time (ACCURACY.md, "The converter"). The bytes depend on
/// the picture, on ISA-L's version, and may on the processor: it has a program for each kind.
/// The picture must have pixels. `out` is overwritten; its memory is used again.
void encode_png(const Plane<std::uint8_t>& picture, std::vector<std::byte>& out);
void encode_png(const Plane<std::uint16_t>& picture, std::vector<std::byte>& out);

/// The same for one picture.
[[nodiscard]] std::vector<std::byte> encode_png(const Plane<std::uint8_t>& picture);
[[nodiscard]] std::vector<std::byte> encode_png(const Plane<std::uint16_t>& picture);

/// A grey PNG of 8 or of 16 bits, of at most 256 million pixels; DataError naming the file if it is another kind or
/// damaged, IoError if it can't be read.
[[nodiscard]] Plane<std::uint8_t> read_png8(const Path& file);
[[nodiscard]] Plane<std::uint16_t> read_png16(const Path& file);

}  // namespace thermal
