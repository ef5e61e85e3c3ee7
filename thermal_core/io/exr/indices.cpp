#include "io/exr/indices.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/index_plane.h"

namespace thermal {
namespace {

constexpr int kLargestInHalf = 2048;  // 2^11: half floats have 11 significant bits (IEEE 754-2019, binary16)

bool is_lossy(std::string_view compression) {
  constexpr std::array<std::string_view, 4> kLossy = {"B44", "B44A", "DWAA", "DWAB"};
  return std::find(kLossy.begin(), kLossy.end(), compression) != kLossy.end();
}

template <typename Number>
void convert(const Plane<Number>& plane, const ExrChannel& channel, Plane<std::uint16_t>& out) {
  out.resize(plane.width_px(), plane.height_px());
  const bool half = channel.type == "half";
  to_indices(plane.pixels(), plane.width_px(), channel.full_name(), out.pixels(),
             half ? kLargestInHalf : kLargestIndex, half ? ", up to which half floats are exact" : "");
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
  if (channel_.type == "uint") {
    convert(pixels_.wholes, channel_, out);
  } else {
    convert(pixels_.floats, channel_, out);
  }
}

}  // namespace thermal
