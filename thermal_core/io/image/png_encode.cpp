#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include "io/image/png.h"

namespace thermal {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// The standard's byte order: big-endian.
std::array<std::uint8_t, 4> big_endian(std::uint32_t number) {
  return {static_cast<std::uint8_t>(number >> 24), static_cast<std::uint8_t>(number >> 16),
          static_cast<std::uint8_t>(number >> 8), static_cast<std::uint8_t>(number)};
}

void append(std::vector<std::byte>& out, Bytes bytes) {
  const auto as_bytes = std::as_bytes(bytes);
  out.insert(out.end(), as_bytes.begin(), as_bytes.end());
}

void append_chunk(std::vector<std::byte>& out, std::string_view type, Bytes content) {
  append(out, big_endian(static_cast<std::uint32_t>(content.size())));
  const Bytes letters(reinterpret_cast<const std::uint8_t*>(type.data()), type.size());
  append(out, letters);
  append(out, content);
  const std::uint32_t sum = ::crc32_gzip_refl(0, letters.data(), letters.size());
  append(out, big_endian(::crc32_gzip_refl(sum, content.data(), content.size())));
}

void append_head(std::vector<std::byte>& out, int width_px, int height_px, std::uint8_t bit_depth) {
  constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append(out, kSignature);
  std::array<std::uint8_t, 13> head{};  // grey, deflate, the standard's filters, not interlaced: all 0
  std::ranges::copy(big_endian(static_cast<std::uint32_t>(width_px)), head.begin());
  std::ranges::copy(big_endian(static_cast<std::uint32_t>(height_px)), head.begin() + 4);
  head[8] = bit_depth;
  append_chunk(out, "IHDR", head);
}

/// Compresses rows, one after another, into chunks of pixels at the end of `out`.
class PixelChunks {
 public:
  explicit PixelChunks(std::vector<std::byte>& out) : out_(out) {
    ::isal_deflate_init(&stream_);
    stream_.level = kLevel;
    stream_.level_buf = search_.data();
    stream_.level_buf_size = static_cast<std::uint32_t>(search_.size());
    stream_.gzip_flag = IGZIP_ZLIB;
    empty();
  }

  /// The row is only read, although the library's pointer is not const.
  void add(std::span<std::uint8_t> row, bool is_last) {
    stream_.next_in = row.data();
    stream_.avail_in = static_cast<std::uint32_t>(row.size());
    stream_.end_of_stream = is_last ? 1 : 0;
    while (stream_.avail_in > 0 || (is_last && stream_.internal_state.state != ZSTATE_END)) {
      if (stream_.avail_out == 0) flush();
      if (::isal_deflate(&stream_) != COMP_OK) throw std::logic_error("ISA-L was called wrongly");
    }
    if (is_last) flush();
  }

 private:
  void empty() {
    stream_.next_out = chunk_.data();
    stream_.avail_out = static_cast<std::uint32_t>(chunk_.size());
  }
  void flush() {
    append_chunk(out_, "IDAT", std::span(chunk_).first(chunk_.size() - stream_.avail_out));
    empty();
  }

  /// Levels 1 and 2 find other repetitions at another memory address, in about one picture of a thousand.
  static constexpr std::uint32_t kLevel = 3;

  std::vector<std::byte>& out_;
  ::isal_zstream stream_{};
  std::array<std::uint8_t, ISAL_DEF_LVL3_DEFAULT> search_{};
  std::array<std::uint8_t, 1 << 16> chunk_{};
};

/// A pixel's bytes in PNG's order.
std::uint8_t as_written(std::uint8_t pixel) { return pixel; }
std::uint16_t as_written(std::uint16_t pixel) {
  if constexpr (std::endian::native == std::endian::big) return pixel;
  return static_cast<std::uint16_t>(pixel << 8 | pixel >> 8);
}

/// PNG's filter "sub": its number, then the difference of each byte to that of the pixel before. All rows of a
/// picture share the buffer.
template <typename T>
class Filter {
 public:
  explicit Filter(std::size_t width_px) : pixels_(width_px), filtered_(1 + width_px * sizeof(T)) {
    constexpr std::uint8_t kSub = 1;
    filtered_[0] = kSub;
  }

  std::span<std::uint8_t> operator()(std::span<const T> row) {
    std::ranges::transform(row, pixels_.begin(), [](T pixel) { return as_written(pixel); });
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(pixels_.data());
    std::uint8_t* const out = &filtered_[1];
    const std::size_t size = row.size_bytes();
    std::copy_n(bytes, sizeof(T), out);
    for (std::size_t i = sizeof(T); i < size; ++i)
      out[i] = static_cast<std::uint8_t>(bytes[i] - bytes[i - sizeof(T)]);
    return filtered_;
  }

 private:
  std::vector<T> pixels_;
  std::vector<std::uint8_t> filtered_;
};

template <typename T>
void encode(const Plane<T>& picture, std::vector<std::byte>& out) {
  assert(picture.size() > 0);
  out.clear();
  append_head(out, picture.width_px(), picture.height_px(), 8 * sizeof(T));
  const auto pixels = std::make_unique<PixelChunks>(out);  // a megabyte, too large for a stack
  Filter<T> filter(static_cast<std::size_t>(picture.width_px()));
  for (int y = 0; y < picture.height_px(); ++y)
    pixels->add(filter(picture.row(y)), y + 1 == picture.height_px());
  append_chunk(out, "IEND", {});
}

template <typename T>
std::vector<std::byte> encoded(const Plane<T>& picture) {
  std::vector<std::byte> file;
  encode(picture, file);
  return file;
}

}  // namespace

void encode_png(const Plane<std::uint8_t>& picture, std::vector<std::byte>& out) { encode(picture, out); }
void encode_png(const Plane<std::uint16_t>& picture, std::vector<std::byte>& out) { encode(picture, out); }

std::vector<std::byte> encode_png(const Plane<std::uint8_t>& picture) { return encoded(picture); }
std::vector<std::byte> encode_png(const Plane<std::uint16_t>& picture) { return encoded(picture); }

}  // namespace thermal
