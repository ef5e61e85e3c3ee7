#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/files.h"

namespace thermal {

/// Destination of a channel's pixels: 4 bytes each.
struct ChannelTarget {
  std::string channel;
  void* first = nullptr;  ///< the first pixel of the part's data window
  std::int32_t bytes_a_line = 0;
  bool whole = false;  ///< std::uint32_t for a uint channel; otherwise float
};

/// Whether decode_part() supports a compression, by its number in the file: all lossless ones, and PXR24. For others,
/// the library's C interface used here gives different results from its C++ interface (3.1.5).
[[nodiscard]] bool can_decode(int compression) noexcept;

/// Decodes channels of one part, scanlines or the finest tiles, each chunk of the file once: the whole data window,
/// which the targets must have memory for. Bits of float and uint channels are kept; half becomes float exactly. For
/// uncompressed 640 x 512 pixels and seven planes this takes a seventh of the time of Imf::InputPart; ZIP is inflated
/// by libdeflate in half of zlib's time.
/// IoError (without the file's name) with the library's reason; pixels are then undefined.
void decode_part(const Path& file, int part, std::span<const ChannelTarget> targets);

}  // namespace thermal
