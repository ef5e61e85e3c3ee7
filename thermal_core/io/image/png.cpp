#include "io/image/png.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <png.h>

#include "base/error.h"
#include "io/pass_buffer.h"

namespace thermal {
namespace {

/// libpng's message when it failed. A pointer to it is libpng's "error pointer".
struct PngFault {
  std::array<char, 128> words{};
};

/// libpng's error function: keeps the message, and jumps back to png_calls().
[[noreturn]] inline void give_up(png_structp png, png_const_charp words) {
  auto& kept = static_cast<PngFault*>(png_get_error_ptr(png))->words;
  std::size_t length = 0;
  for (; words[length] != '\0' && length + 1 < kept.size(); ++length) kept[length] = words[length];
  kept[length] = '\0';
  png_longjmp(png, 1);
}

/// libpng's warning function: nothing below cli prints.
inline void say_nothing(png_structp /*png*/, png_const_charp /*words*/) {}

/// Calls libpng; false if it failed. It jumps over all frames in between, whose objects are not destroyed: `calls`
/// and libpng's callbacks must not own anything when they call libpng, and must not throw.
template <typename Calls>
[[nodiscard]] bool png_calls(png_structp png, const Calls& calls) {
  static_assert(std::is_trivially_destructible_v<Calls>);
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's only way
  calls();
  return true;
}

}  // namespace

std::size_t PngHeader::channels() const noexcept {
  return (colour && !palette ? 3U : 1U) + (alpha ? 1U : 0U);
}

std::int64_t PngHeader::raw_bytes() const noexcept {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const std::int64_t bits_per_pixel = static_cast<std::int64_t>(channels()) * bit_depth;
  const std::int64_t row_bytes = (std::int64_t{width_px} * bits_per_pixel + 7) / 8;
  return row_bytes <= kMost / height_px ? row_bytes * height_px : kMost;
}

void check_plausible(const PngHeader& header, std::int64_t most_pixels) {
  // Deflate makes at best 258 bytes from 2 bits; a far larger claim is not a real picture.
  constexpr std::int64_t kMostRatio = 1032;
  const std::int64_t width = header.width_px;
  if (width > most_pixels || header.height_px > most_pixels / width) {
    throw DataError(fault("size", fmt::format("{} x {}", header.width_px, header.height_px), "px",
                          fmt::format("at most {} pixels", most_pixels)));
  }
  if (header.raw_bytes() / kMostRatio <= header.file_bytes) return;
  throw DataError(fault("pixels", fmt::format("{}", header.raw_bytes()), "bytes",
                        fmt::format("what a file of {} bytes can hold", header.file_bytes)));
}

namespace {

using OpenFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

OpenFile opened(const Path& file) {
  check_is_file(file);
  OpenFile open(std::fopen(file.c_str(), "rbe"), &std::fclose);
  if (!open) throw IoError(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
  return open;
}

/// libpng's read function.
void read_bytes(png_structp png, png_bytep out, std::size_t size) {
  auto* const file = static_cast<std::FILE*>(png_get_io_ptr(png));
  if (std::fread(out, 1, size, file) != size) png_error(png, "the file ends too soon");
}

}  // namespace

/// libpng's memory for one file.
class PngFile::Reading {
 public:
  explicit Reading(const Path& file)
      : file_(opened(file)),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault_, give_up, say_nothing)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
  }
  ~Reading() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  void read_head(std::int64_t file_bytes) {
    const auto calls = [this] {
      be_strict();
      png_read_info(png_, info_);
    };
    const bool is_read = png_calls(png_, calls);
    // libpng knows the length of a row once it has accepted the header.
    if (png_get_rowbytes(png_, info_) == 0) throw DataError("not a PNG file, or its header is damaged");
    if (!is_read) fail();
    const int type = png_get_color_type(png_, info_);
    header_ = {.width_px = png_get_image_width(png_, info_),
               .height_px = png_get_image_height(png_, info_),
               .bit_depth = png_get_bit_depth(png_, info_),
               .palette = type == PNG_COLOR_TYPE_PALETTE,
               .colour = (type & PNG_COLOR_MASK_COLOR) != 0,
               .alpha = (type & PNG_COLOR_MASK_ALPHA) != 0,
               .file_bytes = file_bytes};
  }

  [[nodiscard]] const PngHeader& header() const noexcept { return header_; }

  [[nodiscard]] PngColours colours() const {
    PngColours colours;
    png_colorp palette = nullptr;
    int count = 0;
    if (header_.palette && png_get_PLTE(png_, info_, &palette, &count) != 0) {
      for (const png_color& entry : std::span(palette, static_cast<std::size_t>(count)))
        colours.palette.push_back({entry.red, entry.green, entry.blue});
    }
    png_bytep alphas = nullptr;
    png_color_16p clear = nullptr;
    if (png_get_tRNS(png_, info_, &alphas, &count, &clear) == 0) return colours;
    if (header_.palette) {
      colours.alphas.assign(alphas, alphas + count);
    } else if (header_.colour) {
      colours.clear = {clear->red, clear->green, clear->blue};
    } else {
      colours.clear = {clear->gray, 0, 0};
    }
    return colours;
  }

  void read(const TakeSamples& take) {
    const int turns = begin_rows();
    const std::size_t row_bytes = png_get_rowbytes(png_, info_);
    std::vector<std::uint8_t> rows(row_bytes * (turns > 1 ? header_.height_px : 1));
    for (int turn = 0; turn < turns; ++turn) {
      for (std::size_t y = 0; y < header_.height_px; ++y) {
        const std::span row(&rows[turns > 1 ? y * row_bytes : 0], row_bytes);
        if (!png_calls(png_, [this, row] { png_read_row(png_, row.data(), nullptr); })) fail();
        if (turn == turns - 1) take(static_cast<int>(y), row);
      }
    }
    if (!png_calls(png_, [this] { png_read_end(png_, nullptr); })) fail();
  }

 private:
  /// Makes every fault an error, also in ancillary chunks, and lets only pixels take memory in proportion to their
  /// length.
  void be_strict() {
    constexpr png_uint_32 kNoLimit = PNG_UINT_31_MAX;  // of sides: the caller checks the header
    constexpr png_alloc_size_t kMostChunkBytes = 1 << 26;
    constexpr int kAllThatMayBe = -1;
    png_set_read_fn(png_, file_.get(), read_bytes);
    png_set_user_limits(png_, kNoLimit, kNoLimit);
    png_set_chunk_malloc_max(png_, kMostChunkBytes);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, kAllThatMayBe);
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_benign_errors(png_, 0);
  }

  /// Returns libpng's number of passes over the rows.
  int begin_rows() {
    const auto calls = [this] {
      png_set_packing(png_);
      if (std::endian::native == std::endian::little) png_set_swap(png_);
      turns_ = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    };
    if (!png_calls(png_, calls)) fail();
    return turns_;
  }

  [[noreturn]] void fail() const {
    const std::string_view words = fault_.words.data();
    if (words == "Out of memory") throw std::bad_alloc();  // png_malloc()'s message
    throw DataError(fmt::format("damaged: {}", words));
  }

  OpenFile file_;
  PngFault fault_;
  png_structp png_;
  png_infop info_;
  PngHeader header_;
  int turns_ = 1;
};

PngFile::PngFile(const Path& file) : reading_(std::make_unique<Reading>(file)) {
  reading_->read_head(static_cast<std::int64_t>(std::filesystem::file_size(file)));
}

PngFile::~PngFile() = default;

const PngHeader& PngFile::header() const noexcept { return reading_->header(); }

PngColours PngFile::colours() const { return reading_->colours(); }

void PngFile::read(const TakeSamples& take) { reading_->read(take); }

namespace {

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
  return naming(path, [&path] {
    PngFile file(path);
    return read<T>(file);
  });
}

}  // namespace

Plane<std::uint8_t> read_png8(const Path& file) { return read_named<std::uint8_t>(file); }
Plane<std::uint16_t> read_png16(const Path& file) { return read_named<std::uint16_t>(file); }

}  // namespace thermal
