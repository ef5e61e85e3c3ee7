#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/system/files.h"

struct libdeflate_decompressor;

namespace thermal {

/// Inflates chunks of EXR files compressed with ZIP or ZIPS. Its memory is reused.
class ExrInflater {
 public:
  ExrInflater();
  ~ExrInflater();
  ExrInflater(const ExrInflater&) = delete;
  ExrInflater& operator=(const ExrInflater&) = delete;

  /// Allocates memory for chunks of this size; false if there is not enough.
  [[nodiscard]] bool reserve(std::size_t size) noexcept;

  /// Fills `bytes`, for which memory must be reserved; false if the chunk does not hold exactly as many. Source:
  /// Technical Introduction to OpenEXR, ZIP: differences of neighbouring bytes, first all even bytes, then all odd
  /// ones, deflated.
  [[nodiscard]] bool inflate(std::span<const std::byte> packed, std::span<std::byte> bytes) noexcept;

 private:
  struct Free {
    void operator()(libdeflate_decompressor* decompressor) const noexcept;
  };
  std::unique_ptr<libdeflate_decompressor, Free> decompressor_;
  std::vector<std::byte> halves_;  ///< even bytes, then odd ones
};

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
/// by libdeflate in half of zlib's time. Delete this file when the oldest OpenEXR in use is as fast: 3.2 inflates with
/// libdeflate, and 3.3 builds its C++ interface on the one used here.
/// IoError (without the file's name) with the library's reason; pixels are then undefined.
void decode_part(const Path& file, int part, std::span<const ChannelTarget> targets);

}  // namespace thermal
