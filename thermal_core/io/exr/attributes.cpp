#include "io/exr/attributes.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace thermal {
namespace {

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

}  // namespace

void check_attribute(const std::string& name, const std::string& type, std::int32_t bytes,
                     const std::string& what) {
  check_type(name, type, what);
  check_bytes(type, bytes, what);
}

void check_preview(std::string_view bytes, const std::string& what) {
  const std::int64_t width = value_at<std::uint32_t>(bytes, 0, what);
  const std::int64_t height = value_at<std::uint32_t>(bytes, 4, what);
  const std::int64_t pixels = (static_cast<std::int64_t>(bytes.size()) - 8) / 4;
  if (bytes.size() % 4 == 0 && (width == 0 || height <= pixels / width) && width * height == pixels) return;
  throw DataError(fault(what, fmt::format("{} x {}", width, height), "px",
                        fmt::format("{} pixels, as its size has", pixels)));
}

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

}  // namespace thermal
