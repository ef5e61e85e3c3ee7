#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace thermal {

/// Of objects, materials and actors: Blender's limit of pass_index.
inline constexpr int kLargestIndex = 32767;

/// Values that a pixel of an index plane can hold: a table of this size is never read or written beyond its end.
inline constexpr std::size_t kIndexValues = 65536;

/// The indices that the pixels of a plane state, row by row, in `out` of the same size: the only way from numbers of any
/// other type to an index plane. Number: float, double, std::uint16_t, uint32_t, uint64_t or int64_t.
/// DataError "WHAT at pixel (X, Y) = VALUE; expected a whole number from 0 to LARGEST", and `why`, for the first number
/// that is none; `out` is then not to be used.
template <typename Number>
void to_indices(std::span<const Number> in, int width_px, std::string_view what, std::span<std::uint16_t> out,
                int largest = kLargestIndex, std::string_view why = "");

}  // namespace thermal
