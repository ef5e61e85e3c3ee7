#include "io/video/h264_stream.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "io/video/h264_writer.h"
#include "io/video/video_levels.h"

namespace thermal {
namespace {

/// MPEG-TS packets of 188 bytes, as many as fit an Ethernet frame.
constexpr const char* kWholePackets = "?pkt_size=1316";

ffmpeg::H264Writer::Container container_for(const NetAddress& address) {
  if (address.scheme == "rtsp")
    return {.format = "rtsp", .url = address.url(), .global_header = true, .live = true};
  return {.format = "mpegts", .url = address.url() + kWholePackets, .global_header = false, .live = true};
}

ffmpeg::H264Writer::Fault faults_of(const NetAddress& address) {
  return [url = address.url()](int error) {
    throw IoError(
        fmt::format("cannot send to {}: {}", url,
                    error == AVERROR_ENCODER_NOT_FOUND ? "FFmpeg has no libx264" : ffmpeg::reason_of(error)));
  };
}

}  // namespace

struct H264Stream::Impl {
  std::function<bool()> interrupted;
  ffmpeg::H264Writer writer;

  Impl(const NetAddress& address, const H264Settings& settings, std::function<bool()> ask)
      : interrupted(std::move(ask)),
        writer(container_for(address), settings, faults_of(address), &interrupted) {}
};

H264Stream::H264Stream(const NetAddress& address, double frame_rate_hz, int width_px, int height_px,
                       std::function<bool()> interrupted)
    : impl_(std::make_unique<Impl>(address,
                                   H264Settings{.frame_rate_hz = frame_rate_hz,
                                                .width_px = width_px,
                                                .height_px = height_px,
                                                .preset = "ultrafast",
                                                .quality = 20,
                                                .threads = 1},
                                   std::move(interrupted))) {}

H264Stream::~H264Stream() = default;

void H264Stream::add(const Plane<std::uint8_t>& frame, std::int64_t time) {
  impl_->writer.add([&frame](const VideoPlanes& planes) { draw_grey(frame, planes); }, time);
}

void H264Stream::close() { impl_->writer.close(); }

}  // namespace thermal
