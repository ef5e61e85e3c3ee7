#include "base/image.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/clones.h"
#include "base/error.h"

namespace thermal {
namespace {

/// False for NaN.
template <typename Number>
bool is_index(Number value, int largest) {
  return value >= 0 && value <= static_cast<Number>(largest) &&
         static_cast<Number>(static_cast<std::uint16_t>(value)) == value;
}

/// Converts numbers; false if one is not a valid index.
template <typename Number>
bool convert(const Number* in, std::size_t count, int largest, std::uint16_t* out) {
  bool all = true;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_one = is_index(in[i], largest);
    out[i] = is_one ? static_cast<std::uint16_t>(in[i]) : std::uint16_t{0};
    all = all && is_one;
  }
  return all;
}

/// The pixel types of files.
VELDT_CLONES bool convert(const float* in, std::size_t count, int largest, std::uint16_t* out) {
  const auto most = static_cast<float>(largest);
  std::int32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float positive = in[i] > 0.0F ? in[i] : 0.0F;  // NaN compares false: 0
    const auto index = static_cast<std::int32_t>(positive < most ? positive : most);
    out[i] = static_cast<std::uint16_t>(index);
    bad |= static_cast<float>(index) == in[i] ? 0 : 1;
  }
  return bad == 0;
}

VELDT_CLONES bool convert(const std::uint32_t* in, std::size_t count, int largest, std::uint16_t* out) {
  const auto most = static_cast<std::uint32_t>(largest);
  std::uint32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = static_cast<std::uint16_t>(in[i]);
    bad |= in[i] > most ? 1U : 0U;
  }
  return bad == 0;
}

}  // namespace

template <typename Number>
void to_indices(std::span<const Number> in, int width_px, std::string_view what, std::span<std::uint16_t> out,
                int largest, std::string_view why) {
  if (convert(in.data(), in.size(), largest, out.data())) return;
  const auto bad = std::ranges::find_if_not(in, [largest](Number value) { return is_index(value, largest); });
  const auto at = bad - in.begin();
  throw DataError(fault(fmt::format("{} at pixel ({}, {})", what, at % width_px, at / width_px),
                        fmt::format("{}", *bad), "",
                        fmt::format("a whole number from 0 to {}{}", largest, why)));
}

template void to_indices(std::span<const float>, int, std::string_view, std::span<std::uint16_t>, int,
                         std::string_view);
template void to_indices(std::span<const double>, int, std::string_view, std::span<std::uint16_t>, int,
                         std::string_view);
template void to_indices(std::span<const std::uint16_t>, int, std::string_view, std::span<std::uint16_t>, int,
                         std::string_view);
template void to_indices(std::span<const std::uint32_t>, int, std::string_view, std::span<std::uint16_t>, int,
                         std::string_view);
template void to_indices(std::span<const std::int64_t>, int, std::string_view, std::span<std::uint16_t>, int,
                         std::string_view);
template void to_indices(std::span<const std::uint64_t>, int, std::string_view, std::span<std::uint16_t>, int,
                         std::string_view);

}  // namespace thermal
