#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// Lengths of alternating runs of zeros and ones, zeros first (possibly 0 long), in column-major order.
using RunLengths = std::vector<std::uint32_t>;

/// COCO's compressed run lengths: each count, from the fourth on as the difference to the count two before,
/// in groups of five bits, low group first, a continuation bit above them, offset 48 into ASCII.
[[nodiscard]] std::string encode_coco_rle(const RunLengths& counts);

/// Inverse of encode_coco_rle. DataError if it could not have written the string.
[[nodiscard]] RunLengths decode_coco_rle(std::string_view text);

}  // namespace thermal
