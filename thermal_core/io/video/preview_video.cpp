#include "io/video/preview_video.h"

#include "io/video/video_levels.h"

namespace thermal {
// "medium" takes twenty times as long as "ultrafast" for half the bytes, and lossless frames exist anyway.
PreviewVideo::PreviewVideo(const Path& file, double frame_rate_hz, int width_px, int height_px)
    : file_(file, {.frame_rate_hz = frame_rate_hz,
                   .width_px = width_px,
                   .height_px = height_px,
                   .preset = "ultrafast",
                   .quality = 26,
                   .threads = 1}) {}

void PreviewVideo::add(const Plane<std::uint8_t>& frame) {
  file_.add([&frame](const VideoPlanes& planes) { draw_grey(frame, planes); });
}

void PreviewVideo::close() { file_.close(); }

}  // namespace thermal
