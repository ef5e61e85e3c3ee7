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

/// Converts the numbers of a plane, row by row, to indices in `out`, of the same size: the only way from other number
/// types to an index plane. Number: float, double, std::uint16_t, uint32_t, uint64_t or int64_t.
/// DataError "WHAT at pixel (X, Y) = VALUE; expected a whole number from 0 to LARGEST", and `why`, for the first number
/// that is not an index; `out` is then unspecified.
template <typename Number>
void to_indices(std::span<const Number> in, int width_px, std::string_view what, std::span<std::uint16_t> out,
                int largest = kLargestIndex, std::string_view why = "");

}  // namespace thermal
