#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "io/system/files.h"

namespace thermal {

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
