#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/error.h"
#include "support/test_folder.h"

/// What a fuzz target is given.
using Bytes = std::span<const std::uint8_t>;

inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Ends the target with a fault if a reader accepted something that the code behind it does not expect.
inline void demand(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// Calls a reader; a thermal::Error is what it is meant to throw, every other exception ends the target.
template <typename Read>
void tolerate(const Read& read) {
  try {
    read();
  } catch (const thermal::Error&) {  // every reader must do this
  }
}

/// Writes the bytes to a file of this name, overwriting the last. It is in TMPDIR; on a tmpfs this costs
/// microseconds.
inline std::filesystem::path as_file(Bytes bytes, const std::string& name) {
  static const TestFolder folder;
  return folder.file(name, text_of(bytes));
}
