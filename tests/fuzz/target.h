#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/error.h"
#include "support/temporary_folder.h"

/// What a fuzz target is given.
using Bytes = std::span<const std::uint8_t>;

inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Ends the target with a fault, where a reader let something through that no code behind it expects.
inline void demand(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// Reads; a fault that is told in words is what a reader is for, every other exception ends the target.
template <typename Read>
void tolerate(const Read& read) {
  try {
    read();
  } catch (const thermal::Error&) {  // as every reader promises
  }
}

/// The bytes as a file of this name, which is overwritten by the next. TMPDIR is where; on a tmpfs it costs microseconds.
inline std::filesystem::path as_file(Bytes bytes, const std::string& name) {
  static const TemporaryFolder folder;
  return folder.file(name, text_of(bytes));
}
