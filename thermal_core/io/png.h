#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "io/files.h"

namespace thermal {

/// A grey PNG in memory; lossless.
[[nodiscard]] std::vector<std::byte> encode_png(const Plane<std::uint8_t>& picture);
[[nodiscard]] std::vector<std::byte> encode_png(const Plane<std::uint16_t>& picture);

/// A grey PNG of 8 or of 16 bits; DataError if the file is another kind or damaged, IoError if it can't be read.
[[nodiscard]] Plane<std::uint8_t> read_png8(const Path& file);
[[nodiscard]] Plane<std::uint16_t> read_png16(const Path& file);

}  // namespace thermal
