#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/image.h"

namespace thermal {

/// Encoder settings of a video. Its bytes depend on these, the frames and the encoder's version alone.
struct H264Settings {
  double frame_rate_hz = 9;  ///< > 0
  int width_px = 0;          ///< > 0; an odd side becomes one pixel longer
  int height_px = 0;
  std::string preset = "ultrafast";  ///< of x264
  int quality = 26;                  ///< x264's constant rate factor: 0 lossless, 51 worst
  int threads = 1;  ///< of the encoder: a constant, because the bytes depend on it, never the number of cores
  bool streamable = false;  ///< index first, so that browsers play while loading
};

/// Destination of a video frame's pixels: Y, then U and V of half the size each way. Sides are even.
struct VideoPlanes {
  std::array<std::uint8_t*, 3> data{};
  std::array<int, 3> stride_px{};
  int width_px = 0;
  int height_px = 0;
};

/// Draws grey levels 0 to 255 in video range, 16 to 235 (ITU-R BT.601), without colour. Where the video is a pixel
/// longer, the edge is repeated.
void draw_grey(const Plane<std::uint8_t>& frame, const VideoPlanes& out);

}  // namespace thermal
