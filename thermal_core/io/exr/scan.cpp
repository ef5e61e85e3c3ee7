#include "io/exr/scan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "io/exr/attributes.h"

namespace thermal {
namespace {

static_assert(std::endian::native == std::endian::little,
              "EXR files are little-endian, and so is what we read them with");

constexpr std::int32_t kMagic = 20000630;
constexpr std::int32_t kVersion = 2;
constexpr std::int32_t kVersionMask = 0xFF;
constexpr std::int32_t kTiledFlag = 0x200;
constexpr std::int32_t kLongNamesFlag = 0x400;
constexpr std::int32_t kDeepFlag = 0x800;
constexpr std::int32_t kMultiPartFlag = 0x1000;
constexpr std::int64_t kBytesAChunk = 8;  // of the table of chunk offsets

struct Window {
  std::int32_t left = 0;
  std::int32_t top = 0;
  std::int32_t right = 0;
  std::int32_t bottom = 0;

  [[nodiscard]] std::int64_t width() const noexcept { return std::int64_t{right} - left + 1; }
  [[nodiscard]] std::int64_t height() const noexcept { return std::int64_t{bottom} - top + 1; }
};

/// Fields of a part's header that determine memory use.
struct PartHeader {
  std::optional<Window> data_window;
  std::optional<Window> display_window;
  std::optional<std::uint8_t> compression;
  std::uint32_t tile_width_px = 0;  ///< 0: scanlines
  std::uint32_t tile_height_px = 0;
  std::int32_t chunk_count = 0;  ///< 0: unknown
  ExrChannelList channels;
};

/// Scanlines per chunk, by number of the compression.
std::int64_t lines_a_chunk(std::uint8_t compression) {
  constexpr std::array<std::int64_t, 10> kLines = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  if (compression < kLines.size()) return kLines[compression];
  throw DataError(fault("compression", std::to_string(compression), "", "0 (none) to 9 (DWAB)"));
}

std::int64_t parts_of(std::int64_t whole, std::int64_t part) { return (whole + part - 1) / part; }

/// Reads values one after another; reading past the end is a fault.
class ByteReader {
 public:
  explicit ByteReader(const Path& file) : in_(file, std::ios::binary) {
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (!in_ || error) throw DataError("cannot be opened");
    left_ = static_cast<std::int64_t>(size);
  }

  [[nodiscard]] std::int64_t left() const noexcept { return left_; }

  template <typename T>
  T value(const std::string& what) {
    T read{};
    take(&read, sizeof(T), what);
    return read;
  }

  /// A string that ends with a zero byte; empty if that comes first.
  std::string text(const std::string& what, std::size_t longest) {
    std::string read;
    for (char c = value<char>(what); c != '\0'; c = value<char>(what)) {
      if (read.size() == longest)
        throw DataError(fault(what, fmt::format("over {}", longest), "characters", "fewer"));
      read += c;
    }
    return read;
  }

  std::string bytes(std::int64_t count, const std::string& what) {
    check_left(count, what);
    std::string read(static_cast<std::size_t>(count), '\0');
    take(read.data(), read.size(), what);
    return read;
  }

  void skip(std::int64_t count, const std::string& what) {
    check_left(count, what);
    in_.seekg(count, std::ios::cur);
    left_ -= count;
  }

 private:
  void take(void* to, std::size_t count, const std::string& what) {
    check_left(static_cast<std::int64_t>(count), what);
    errno = 0;
    in_.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
    if (!in_) throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), what);
    left_ -= static_cast<std::int64_t>(count);
  }

  void check_left(std::int64_t count, const std::string& what) const {
    if (count >= 0 && count <= left_) return;
    throw DataError(
        fault(what, std::to_string(count), "bytes", fmt::format("at most the {} left in the file", left_)));
  }

  std::ifstream in_;
  std::int64_t left_ = 0;
};

class HeaderScan {
 public:
  HeaderScan(const Path& file, const ExrLimits& limits) : in_(file), limits_(limits) {}

  void run() {
    if (in_.left() < 8 || in_.value<std::int32_t>("magic number") != kMagic)
      throw DataError("not an EXR file (wrong first bytes)");
    const auto version = in_.value<std::int32_t>("version");
    if ((version & kVersionMask) != kVersion)
      throw DataError(fault("version", std::to_string(version & kVersionMask), "", "2"));
    if ((version & kDeepFlag) != 0) throw DataError("holds deep data; expected flat pixels");
    tiled_ = (version & kTiledFlag) != 0;
    longest_name_ = (version & kLongNamesFlag) != 0 ? 255 : 31;
    read_headers((version & kMultiPartFlag) != 0);
    std::int64_t chunks = 0;
    for (std::size_t part = 0; part < parts_.size(); ++part) chunks += chunks_of(parts_[part], part);
    if (chunks * kBytesAChunk > in_.left())
      throw DataError(fault("table of chunks", std::to_string(chunks * kBytesAChunk), "bytes",
                            fmt::format("at most the {} left in the file", in_.left())));
  }

 private:
  void read_headers(bool several) {
    int channels = 0;
    while (true) {
      std::optional<PartHeader> part = read_header();
      if (!part && several) break;  // an empty header ends the list
      parts_.push_back(part.value_or(PartHeader{}));
      channels += parts_.back().channels.count;
      if (channels > limits_.channels)
        throw DataError(
            fault("channels", std::to_string(channels), "", fmt::format("at most {}", limits_.channels)));
      if (static_cast<int>(parts_.size()) > limits_.parts)
        throw DataError(
            fault("parts", std::to_string(parts_.size()), "", fmt::format("at most {}", limits_.parts)));
      if (!several) break;
    }
    if (parts_.empty()) throw DataError("has no parts; expected at least one");
  }

  /// Empty if there is no such attribute.
  std::optional<PartHeader> read_header() {
    std::optional<PartHeader> part;
    while (true) {
      const std::string name = in_.text("name of an attribute", longest_name_);
      if (name.empty()) return part;
      if (!part) part.emplace();
      const std::string what = fmt::format("part {}: {}", parts_.size(), name);
      const std::string type = in_.text("type of " + name, longest_name_);
      read_attribute(name, type, in_.value<std::int32_t>(what), what, *part);
    }
  }

  void read_attribute(const std::string& name, const std::string& type, std::int32_t size,
                      const std::string& what, PartHeader& part) {
    check_attribute(name, type, size, what);
    if (type == "preview") {
      check_preview(in_.bytes(size, what), what);
    } else if (type == "stringvector") {
      check_texts(in_.bytes(size, what), what);
    } else if (name == "dataWindow" && type == "box2i") {
      const std::string bytes = in_.bytes(size, what);
      part.data_window = value_at<Window>(bytes, 0, what);
    } else if (name == "displayWindow" && type == "box2i") {
      const std::string bytes = in_.bytes(size, what);
      part.display_window = value_at<Window>(bytes, 0, what);
    } else if (name == "compression" && type == "compression") {
      const std::string bytes = in_.bytes(size, what);
      part.compression = value_at<std::uint8_t>(bytes, 0, what);
    } else if (name == "tiles" && type == "tiledesc") {
      const std::string bytes = in_.bytes(size, what);
      part.tile_width_px = value_at<std::uint32_t>(bytes, 0, what);
      part.tile_height_px = value_at<std::uint32_t>(bytes, 4, what);
    } else if (type == "chlist") {
      const ExrChannelList channels = read_channel_list(in_.bytes(size, what), what);
      if (name == "channels") part.channels = channels;
    } else if (name == "chunkCount" && type == "int") {
      const std::string bytes = in_.bytes(size, what);
      part.chunk_count = value_at<std::int32_t>(bytes, 0, what);
    } else {
      in_.skip(size, what);
    }
  }

  /// Entries of a part's table. With levels of detail there are more; a file must be long enough for the finest.
  [[nodiscard]] std::int64_t chunks_of(const PartHeader& part, std::size_t number) const {
    const std::string where = fmt::format("part {}: ", number);
    if (!part.data_window) throw DataError(where + "no dataWindow; expected one");
    if (!part.display_window) throw DataError(where + "no displayWindow; expected one");
    if (!part.compression) throw DataError(where + "no compression; expected one");
    const std::int64_t width = part.data_window->width();
    const std::int64_t height = part.data_window->height();
    check_size(width, height, where + "dataWindow");
    check_size(part.display_window->width(), part.display_window->height(), where + "displayWindow");
    check_plausible(width * height * part.channels.bytes_per_pixel, where);
    if (part.chunk_count < 0)
      throw DataError(fault(where + "chunkCount", std::to_string(part.chunk_count), "", "0 or more"));
    return std::max<std::int64_t>(part.chunk_count, chunks_of(part, width, height, where));
  }

  [[nodiscard]] std::int64_t chunks_of(const PartHeader& part, std::int64_t width, std::int64_t height,
                                       const std::string& where) const {
    if (part.tile_width_px == 0 && part.tile_height_px == 0 && !tiled_)
      return parts_of(height, lines_a_chunk(*part.compression));
    check_size(part.tile_width_px, part.tile_height_px, where + "tiles");
    check_plausible(std::int64_t{part.tile_width_px} * part.tile_height_px * part.channels.bytes_per_pixel,
                    where);
    return parts_of(width, part.tile_width_px) * parts_of(height, part.tile_height_px);
  }

  void check_size(std::int64_t width, std::int64_t height, const std::string& what) const {
    const std::string size = fmt::format("{} x {}", width, height);
    if (width < 1 || height < 1) throw DataError(fault(what, size, "px", "sides of at least 1"));
    if (width <= limits_.pixels / height) return;
    constexpr double kMillion = 1e6;
    throw DataError(fault(
        what, size,
        fmt::format("px, {} megapixels", static_cast<double>(width) * static_cast<double>(height) / kMillion),
        fmt::format("at most {} (see --max-megapixels)", static_cast<double>(limits_.pixels) / kMillion)));
  }

  /// No compression makes a part smaller than 1/65536 of its pixels plus a few bytes per chunk.
  void check_plausible(std::int64_t bytes, const std::string& where) const {
    constexpr std::int64_t kMostRatio = 65536;
    constexpr std::int64_t kAlwaysFine = 1 << 20;
    if (bytes <= kAlwaysFine || bytes / kMostRatio <= in_.left()) return;
    throw DataError(fault(where + "pixels", std::to_string(bytes), "bytes",
                          fmt::format("what the {} bytes left in the file can hold", in_.left())));
  }

  ByteReader in_;
  ExrLimits limits_;
  bool tiled_ = false;
  std::size_t longest_name_ = 31;
  std::vector<PartHeader> parts_;
};

}  // namespace

void check_exr_headers(const Path& file, const ExrLimits& limits) { HeaderScan(file, limits).run(); }

}  // namespace thermal
