#include "io/exr/indices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/clones.h"
#include "base/error.h"
#include "scene/manifest.h"

namespace thermal {
namespace {

constexpr int kLargestInHalf = 2048;  // 2^11: half floats have 11 significant bits (IEEE 754-2019, binary16)

bool is_lossy(std::string_view compression) {
  constexpr std::array<std::string_view, 4> kLossy = {"B44", "B44A", "DWAA", "DWAB"};
  return std::find(kLossy.begin(), kLossy.end(), compression) != kLossy.end();
}

/// False for NaN.
template <typename Number>
bool is_index(Number value, int largest) {
  return value >= 0 && value <= static_cast<Number>(largest) &&
         static_cast<Number>(static_cast<std::uint16_t>(value)) == value;
}

std::string rule_for(int largest) {
  const std::string rule = fmt::format("a whole number from 0 to {}", largest);
  return largest == kLargestInHalf ? rule + ", up to which half floats are exact" : rule;
}

template <typename Number>
[[noreturn]] void refuse(const Plane<Number>& plane, const std::string& channel, int largest) {
  const auto pixels = plane.pixels();
  const auto bad =
      std::find_if_not(pixels.begin(), pixels.end(), [=](Number value) { return is_index(value, largest); });
  const auto at = static_cast<int>(bad - pixels.begin());
  throw DataError(
      fault(fmt::format("{} at pixel ({}, {})", channel, at % plane.width_px(), at / plane.width_px()),
            fmt::format("{}", *bad), "", rule_for(largest)));
}

/// Converts numbers to indices; false if one is not an index, which then differs from its number.
VELDT_CLONES bool convert_floats(const float* in, std::size_t count, float largest, std::uint16_t* out) {
  std::int32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float positive = in[i] > 0.0F ? in[i] : 0.0F;  // NaN compares false: 0
    const auto index = static_cast<std::int32_t>(positive < largest ? positive : largest);
    out[i] = static_cast<std::uint16_t>(index);
    bad |= static_cast<float>(index) == in[i] ? 0 : 1;
  }
  return bad == 0;
}

VELDT_CLONES bool convert_wholes(const std::uint32_t* in, std::size_t count, std::uint32_t largest,
                                 std::uint16_t* out) {
  std::uint32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = static_cast<std::uint16_t>(in[i]);
    bad |= in[i] > largest ? 1U : 0U;
  }
  return bad == 0;
}

bool convert(const Plane<float>& plane, int largest, std::uint16_t* out) {
  return convert_floats(plane.pixels().data(), plane.size(), static_cast<float>(largest), out);
}

bool convert(const Plane<std::uint32_t>& plane, int largest, std::uint16_t* out) {
  return convert_wholes(plane.pixels().data(), plane.size(), static_cast<std::uint32_t>(largest), out);
}

template <typename Number>
void to_indices(const Plane<Number>& plane, const std::string& channel, int largest,
                Plane<std::uint16_t>& out) {
  out.resize(plane.width_px(), plane.height_px());
  if (!convert(plane, largest, out.pixels().data())) refuse(plane, channel, largest);
}

}  // namespace

ExrIndexPlane::ExrIndexPlane(const ExrChannel& channel, IndexPixels& pixels)
    : channel_(channel), pixels_(pixels) {
  if (!is_lossy(channel.compression)) return;
  throw DataError(fault(channel.full_name() + ": compression", channel.compression, "",
                        "a lossless one (none, RLE, ZIPS, ZIP, PIZ or PXR24): others change indices"));
}

ExrTarget ExrIndexPlane::target() {
  ExrTarget target{.channel = &channel_, .plane = &pixels_.floats, .outside = 0};
  if (channel_.type == "uint") target.plane = &pixels_.wholes;
  return target;
}

void ExrIndexPlane::indices(Plane<std::uint16_t>& out) const {
  const std::string name = channel_.full_name();
  if (channel_.type == "uint") {
    to_indices(pixels_.wholes, name, kLargestIndex, out);
  } else {
    to_indices(pixels_.floats, name, channel_.type == "half" ? kLargestInHalf : kLargestIndex, out);
  }
}

}  // namespace thermal
