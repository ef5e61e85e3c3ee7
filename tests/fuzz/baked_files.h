#pragma once

#include <algorithm>
#include <cmath>

#include "fuzz/target.h"

/// An input for a file of arrays: its JSON, a NUL byte, and the arrays. Without a NUL byte there are none.
struct BakedInput {
  Bytes json;
  Bytes arrays;
};

inline BakedInput split(Bytes bytes) {
  const auto length = static_cast<std::size_t>(std::ranges::find(bytes, 0) - bytes.begin());
  return {.json = bytes.first(length), .arrays = bytes.subspan(std::min(length + 1, bytes.size()))};
}

/// Writes NAME.json and NAME.bin, and returns their folder.
inline std::filesystem::path as_baked(Bytes bytes, const std::string& name) {
  const BakedInput input = split(bytes);
  (void)as_file(input.arrays, name + ".bin");
  return as_file(input.json, name + ".json").parent_path();
}

template <typename Rows>
bool all_finite(const Rows& rows) {
  return std::ranges::all_of(rows, [](const auto& row) {
    return std::ranges::all_of(row, [](auto value) { return std::isfinite(value); });
  });
}
