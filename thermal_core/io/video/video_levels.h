#pragma once

#include "base/image.h"
#include "io/video/h264_settings.h"

namespace thermal {

/// Draws grey levels 0 to 255 in video range, 16 to 235 (ITU-R BT.601), without colour. Where the video is a pixel
/// longer, the edge is repeated.
void draw_grey(const Plane<std::uint8_t>& frame, const VideoPlanes& out);

}  // namespace thermal
