#include "labels/rle.h"

#include <limits>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr int kGroupBits = 5;
constexpr int kGroupMask = 0x1F;
constexpr int kSignBit = 0x10;
constexpr int kContinues = 0x20;
constexpr int kAsciiOffset = 48;

}  // namespace

std::string encode_coco_rle(const RunLengths& counts) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    auto rest = static_cast<std::int64_t>(counts[i]);
    if (i > 2) rest -= static_cast<std::int64_t>(counts[i - 2]);
    bool more = true;
    while (more) {
      int group = static_cast<int>(rest & kGroupMask);
      rest >>= kGroupBits;
      more = (group & kSignBit) != 0 ? rest != -1 : rest != 0;
      if (more) group |= kContinues;
      text.push_back(static_cast<char>(group + kAsciiOffset));
    }
  }
  return text;
}

RunLengths decode_coco_rle(std::string_view text) {
  const auto broken = [text] {
    return DataError(fmt::format("run lengths \"{}\" are not a COCO mask", text));
  };
  RunLengths counts;
  std::size_t at = 0;
  while (at < text.size()) {
    std::int64_t value = 0;
    int shift = 0;
    int group = kContinues;
    while ((group & kContinues) != 0) {
      if (at == text.size() || shift > 30) throw broken();
      group = text[at++] - kAsciiOffset;
      if (group < 0 || group > (kGroupMask | kContinues)) throw broken();
      value |= static_cast<std::int64_t>(group & kGroupMask) << shift;
      shift += kGroupBits;
    }
    if ((group & kSignBit) != 0) value -= std::int64_t{1} << shift;
    if (counts.size() > 2) value += counts[counts.size() - 2];
    if (value < 0 || value > std::numeric_limits<std::uint32_t>::max()) throw broken();
    counts.push_back(static_cast<std::uint32_t>(value));
  }
  return counts;
}

}  // namespace thermal
