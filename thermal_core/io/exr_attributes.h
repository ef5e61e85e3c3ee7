#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.h"

namespace thermal {

// Attributes of EXR headers, as files have them and nobody has checked. `what` begins the words of faults. All faults
// are DataErrors. A library reads of most types what those have, whatever size the file says, and goes on behind that:
// where the two differ, it sees another file than whoever believes the size.
// Source: Technical Introduction to OpenEXR, "Attribute Layout".

/// Whether an attribute that a library takes for what its name says is of that type, and one whose type has a size of
/// that size.
void check_attribute(const std::string& name, const std::string& type, std::int32_t bytes,
                     const std::string& what);

/// A preview: two numbers, and as many pixels of four bytes.
void check_preview(std::string_view bytes, const std::string& what);

/// Texts, each behind its length.
void check_texts(std::string_view bytes, const std::string& what);

/// What a channel list says that memory hangs on.
struct ExrChannelList {
  int count = 0;
  std::int64_t bytes_per_pixel = 0;
};

/// Entries of a channel list: a name, a zero byte, 16 bytes that begin with the type; a zero byte after the last.
[[nodiscard]] ExrChannelList read_channel_list(std::string_view bytes, const std::string& what);

/// A number that begins at a byte.
template <typename T>
T value_at(std::string_view bytes, std::size_t at, const std::string& what) {
  T read{};
  if (at + sizeof(T) > bytes.size())
    throw DataError(fault(what, std::to_string(bytes.size()), "bytes", "more"));
  std::memcpy(&read, bytes.data() + at, sizeof(T));
  return read;
}

}  // namespace thermal
