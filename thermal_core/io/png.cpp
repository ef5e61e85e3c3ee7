#include "io/png.h"

#include <bit>
#include <cassert>
#include <cstring>
#include <new>
#include <span>

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include "base/error.h"
#include "io/pass_reader.h"
#include "io/png_calls.h"
#include "io/png_file.h"

namespace thermal {
namespace {

/// libpng's memory while it writes a picture to the end of `out`.
class Encoder {
 public:
  explicit Encoder(std::vector<std::byte>& out)
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &fault_, give_up, say_nothing)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ != nullptr) png_set_write_fn(png_, &out, append, [](png_structp) {});
  }
  ~Encoder() { png_destroy_write_struct(&png_, &info_); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  template <typename T>
  void write(const Plane<T>& picture) {
    const auto calls = [this, &picture] {
      choose(picture.width_px(), picture.height_px(), 8 * sizeof(T));
      for (int y = 0; y < picture.height_px(); ++y)
        png_write_row(png_, reinterpret_cast<png_const_bytep>(picture.row(y).data()));
      png_write_end(png_, nullptr);
    };
    // Of pixels in memory, nothing but that can fail.
    if (info_ == nullptr || !png_calls(png_, calls)) throw std::bad_alloc();
  }

 private:
  /// What was measured to be fast and small (ACCURACY.md).
  void choose(int width_px, int height_px, int bit_depth) {
    constexpr png_uint_32 kNoLimit = PNG_UINT_31_MAX;
    constexpr std::size_t kChunkBytes = 1 << 16;
    png_set_user_limits(png_, kNoLimit, kNoLimit);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width_px), static_cast<png_uint_32>(height_px),
                 bit_depth, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_AVG);
    png_set_compression_level(png_, Z_BEST_SPEED);
    png_set_compression_strategy(png_, Z_RLE);
    png_set_compression_buffer_size(png_, kChunkBytes);
    png_write_info(png_, info_);
    if (std::endian::native == std::endian::little) png_set_swap(png_);  // of no effect on 8 bits
  }

  static bool has_appended(std::vector<std::byte>& out, std::span<const std::byte> bytes) noexcept {
    try {
      out.insert(out.end(), bytes.begin(), bytes.end());
      return true;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

  static void append(png_structp png, png_bytep data, std::size_t size) {
    auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    if (!has_appended(out, std::as_bytes(std::span(data, size)))) png_error(png, "no memory");
  }

  PngFault fault_;
  png_structp png_;
  png_infop info_;
};

template <typename T>
void encode(const Plane<T>& picture, std::vector<std::byte>& out) {
  assert(picture.size() > 0);
  out.clear();
  Encoder(out).write(picture);
}

template <typename T>
std::vector<std::byte> encoded(const Plane<T>& picture) {
  std::vector<std::byte> file;
  encode(picture, file);
  return file;
}

std::string kind_told(const PngHeader& header) {
  const std::string_view colours = header.palette ? "palette" : header.colour ? "colour" : "grey";
  return fmt::format("{}{} of {}", colours, header.alpha ? " and alpha" : "", header.bit_depth);
}

template <typename T>
Plane<T> read(PngFile& file) {
  const PngHeader& header = file.header();
  constexpr int kBits = 8 * sizeof(T);
  if (header.colour || header.alpha || header.bit_depth != kBits)
    throw DataError(fault("pixels", kind_told(header), "bits", fmt::format("grey of {} bits", kBits)));
  check_plausible(header, ReadLimits().pixels);
  Plane<T> picture(static_cast<int>(header.width_px), static_cast<int>(header.height_px));
  file.read([&picture](int y, std::span<const std::uint8_t> row) {
    std::memcpy(picture.row(y).data(), row.data(), row.size());
  });
  return picture;
}

template <typename T>
Plane<T> read_named(const Path& path) {
  try {
    PngFile file(path);
    return read<T>(file);
  } catch (const DataError& error) {
    throw DataError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace

void encode_png(const Plane<std::uint8_t>& picture, std::vector<std::byte>& out) { encode(picture, out); }
void encode_png(const Plane<std::uint16_t>& picture, std::vector<std::byte>& out) { encode(picture, out); }

std::vector<std::byte> encode_png(const Plane<std::uint8_t>& picture) { return encoded(picture); }
std::vector<std::byte> encode_png(const Plane<std::uint16_t>& picture) { return encoded(picture); }

Plane<std::uint8_t> read_png8(const Path& file) { return read_named<std::uint8_t>(file); }
Plane<std::uint16_t> read_png16(const Path& file) { return read_named<std::uint16_t>(file); }

}  // namespace thermal
