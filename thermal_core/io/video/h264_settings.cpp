#include "io/video/h264_settings.h"

#include <algorithm>
#include <cstddef>

namespace thermal {
namespace {

/// Scales to video range: 16 to 235 (ITU-R BT.601).
std::uint8_t video_level(std::uint8_t level) {
  const auto scaled = static_cast<std::uint16_t>(219 * level + 127);  // at most 55,972
  return static_cast<std::uint8_t>(16 + scaled / 255);
}

}  // namespace

void draw_grey(const Plane<std::uint8_t>& frame, const VideoPlanes& out) {
  for (int y = 0; y < out.height_px; ++y) {
    const auto row = frame.row(std::min(y, frame.height_px() - 1));
    std::uint8_t* const to = out.data[0] + static_cast<std::ptrdiff_t>(y) * out.stride_px[0];
    std::transform(row.begin(), row.end(), to, video_level);
    std::fill(to + row.size(), to + out.width_px, video_level(row.back()));
  }
  constexpr std::uint8_t kNoColour = 128;
  for (const std::size_t plane : {1U, 2U})
    std::fill_n(out.data[plane], out.stride_px[plane] * (out.height_px / 2), kNoColour);
}

}  // namespace thermal
