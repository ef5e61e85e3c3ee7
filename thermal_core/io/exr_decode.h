#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/files.h"

namespace thermal {

/// Where a channel's pixels go: 4 bytes each.
struct ChannelTarget {
  std::string channel;
  void* first = nullptr;  ///< the first pixel of the part's data window
  std::int32_t bytes_a_line = 0;
  bool whole = false;  ///< std::uint32_t, for a channel of those; else float
};

/// Whether decode_part() knows a compression, by its number in the file: all that keep pixels as they are, and PXR24.
/// What the library's C interface, which this stands on, makes of the others is not what its C++ interface does (3.1.5).
[[nodiscard]] bool can_decode(int compression) noexcept;

/// Decodes channels of one part, scanlines or the finest tiles, each chunk of the file once: all of its data window, for
/// which the targets must have room. Bits of float and uint channels are kept; half becomes float exactly.
/// Of uncompressed 640 x 512 pixels and seven planes this takes a seventh of the time of Imf::InputPart; what is
/// compressed with ZIP is inflated by libdeflate in half of zlib's time.
/// IoError (without the file's name) with the library's reason; pixels are then undefined.
void decode_part(const Path& file, int part, std::span<const ChannelTarget> targets);

}  // namespace thermal
