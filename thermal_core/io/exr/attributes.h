#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.h"

namespace thermal {

// Checks of attributes of EXR headers from untrusted files. `what` starts the messages. All faults are DataErrors. For
// most types a library reads the type's own size, ignoring the size in the file, and continues after that: if the two
// differ, it reads a different file than a reader that trusts the stated size.
// Source: Technical Introduction to OpenEXR, "Attribute Layout".

/// Checks that an attribute that a library interprets by name has the right type, and that a type of known size has
/// that size.
void check_attribute(const std::string& name, const std::string& type, std::int32_t bytes,
                     const std::string& what);

/// A preview: two numbers, and that many pixels of four bytes.
void check_preview(std::string_view bytes, const std::string& what);

/// Strings, each preceded by its length.
void check_texts(std::string_view bytes, const std::string& what);

/// Properties of a channel list that determine memory use.
struct ExrChannelList {
  int count = 0;
  std::int64_t bytes_per_pixel = 0;
};

/// Entries of a channel list: a name, a zero byte, 16 bytes that start with the type; a zero byte after the last.
[[nodiscard]] ExrChannelList read_channel_list(std::string_view bytes, const std::string& what);

/// Reads a number at a byte offset.
template <typename T>
T value_at(std::string_view bytes, std::size_t at, const std::string& what) {
  T read{};
  if (at + sizeof(T) > bytes.size())
    throw DataError(fault(what, std::to_string(bytes.size()), "bytes", "more"));
  std::memcpy(&read, bytes.data() + at, sizeof(T));
  return read;
}

}  // namespace thermal
