#include "io/exr/header_check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

// Checks of attributes of EXR headers from untrusted files. `what` starts the messages. All faults are DataErrors. For
// most types a library reads the type's own size, ignoring the size in the file, and continues after that: if the two
// differ, it reads a different file than a reader that trusts the stated size.
// Source: Technical Introduction to OpenEXR, "Attribute Layout".

/// Properties of a channel list that determine memory use.
struct ExrChannelList {
  int count = 0;
  std::int64_t bytes_per_pixel = 0;
};

/// Reads a number at a byte offset.
template <typename T>
T value_at(std::string_view bytes, std::size_t at, const std::string& what) {
  T read{};
  if (at + sizeof(T) > bytes.size())
    throw DataError(fault(what, std::to_string(bytes.size()), "bytes", "more"));
  std::memcpy(&read, bytes.data() + at, sizeof(T));
  return read;
}

struct Sized {
  std::string_view type;
  std::int32_t bytes;
};

/// Types of known size; for a negative value, the size must be a multiple of it.
constexpr std::array<Sized, 25> kSized = {{{"box2i", 16},
                                           {"box2f", 16},
                                           {"chromaticities", 32},
                                           {"compression", 1},
                                           {"deepImageState", 1},
                                           {"double", 8},
                                           {"envmap", 1},
                                           {"float", 4},
                                           {"int", 4},
                                           {"keycode", 28},
                                           {"lineOrder", 1},
                                           {"m33d", 72},
                                           {"m33f", 36},
                                           {"m44d", 128},
                                           {"m44f", 64},
                                           {"rational", 8},
                                           {"tiledesc", 9},
                                           {"timecode", 8},
                                           {"v2d", 16},
                                           {"v2f", 8},
                                           {"v2i", 8},
                                           {"v3d", 24},
                                           {"v3f", 12},
                                           {"v3i", 12},
                                           {"floatvector", -4}}};

/// Attributes that a library interprets by name.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kTyped = {
    {{"channels", "chlist"},
     {"chunkCount", "int"},
     {"compression", "compression"},
     {"dataWindow", "box2i"},
     {"displayWindow", "box2i"},
     {"lineOrder", "lineOrder"},
     {"name", "string"},
     {"pixelAspectRatio", "float"},
     {"screenWindowCenter", "v2f"},
     {"screenWindowWidth", "float"},
     {"tiles", "tiledesc"},
     {"type", "string"}}};

void check_type(const std::string& name, const std::string& type, const std::string& what) {
  const auto* const known =
      std::ranges::find(kTyped, name, &std::pair<std::string_view, std::string_view>::first);
  if (known != kTyped.end() && known->second != type)
    throw DataError(fault(what + ": type", type, "", known->second));
}

void check_bytes(const std::string& type, std::int32_t size, const std::string& what) {
  const auto* const known = std::ranges::find(kSized, type, &Sized::type);
  if (known == kSized.end() || (known->bytes < 0 ? size % known->bytes == 0 : size == known->bytes)) return;
  const std::string rule =
      fmt::format(fmt::runtime(known->bytes < 0 ? "a multiple of {}" : "{}"), std::abs(known->bytes));
  throw DataError(fault(what, std::to_string(size), "bytes", fmt::format("{}, as type {} has", rule, type)));
}

/// Checks that an attribute that a library interprets by name has the right type, and that a type of known size has
/// that size.
void check_attribute(const std::string& name, const std::string& type, std::int32_t bytes,
                     const std::string& what) {
  check_type(name, type, what);
  check_bytes(type, bytes, what);
}

/// A preview: two numbers, and that many pixels of four bytes.
void check_preview(std::string_view bytes, const std::string& what) {
  const std::int64_t width = value_at<std::uint32_t>(bytes, 0, what);
  const std::int64_t height = value_at<std::uint32_t>(bytes, 4, what);
  const std::int64_t pixels = (static_cast<std::int64_t>(bytes.size()) - 8) / 4;
  if (bytes.size() % 4 == 0 && (width == 0 || height <= pixels / width) && width * height == pixels) return;
  throw DataError(fault(what, fmt::format("{} x {}", width, height), "px",
                        fmt::format("{} pixels, as its size has", pixels)));
}

/// Strings, each preceded by its length.
void check_texts(std::string_view bytes, const std::string& what) {
  for (std::size_t at = 0; at < bytes.size();) {
    const auto length = value_at<std::int32_t>(bytes, at, what);
    at += sizeof(length);
    if (length < 0 || static_cast<std::size_t>(length) > bytes.size() - at)
      throw DataError(fault(what + ": text", std::to_string(length), "bytes",
                            fmt::format("at most {}", bytes.size() - at)));
    at += static_cast<std::size_t>(length);
  }
}

/// Entries of a channel list: a name, a zero byte, 16 bytes that start with the type; a zero byte after the last.
ExrChannelList read_channel_list(std::string_view bytes, const std::string& what) {
  constexpr std::size_t kBytesAfterName = 16;
  constexpr std::array<std::int64_t, 3> kBytesOfType = {4, 2, 4};  // uint, half, float
  ExrChannelList channels;
  std::size_t at = 0;
  while (at < bytes.size() && bytes[at] != '\0') {
    const std::size_t end = bytes.find('\0', at);
    if (end == std::string_view::npos || end + 1 + kBytesAfterName >= bytes.size())
      throw DataError(what + " ends within a channel; expected a complete list");
    const auto type = value_at<std::uint32_t>(bytes, end + 1, what);
    if (type >= kBytesOfType.size())
      throw DataError(fault(what + ": type", std::to_string(type), "", "0 (uint), 1 (half) or 2 (float)"));
    channels.bytes_per_pixel += kBytesOfType[type];
    ++channels.count;
    at = end + 1 + kBytesAfterName;
  }
  // A library stops at the first empty name, and parses the rest as the next attribute.
  if (at + 1 != bytes.size())
    throw DataError(what + " continues after its end; expected a zero byte only at the end");
  return channels;
}

static_assert(std::endian::native == std::endian::little,
              "EXR files are little-endian, and so is what we read them with");

constexpr std::int32_t kMagic = 20000630;
constexpr std::int32_t kVersion = 2;
constexpr std::int32_t kVersionMask = 0xFF;
constexpr std::int32_t kTiledFlag = 0x200;
constexpr std::int32_t kLongNamesFlag = 0x400;
constexpr std::int32_t kDeepFlag = 0x800;
constexpr std::int32_t kMultiPartFlag = 0x1000;
constexpr std::int64_t kBytesPerChunk = 8;  // of the table of chunk offsets

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
    if (chunks * kBytesPerChunk > in_.left())
      throw DataError(fault("table of chunks", std::to_string(chunks * kBytesPerChunk), "bytes",
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
