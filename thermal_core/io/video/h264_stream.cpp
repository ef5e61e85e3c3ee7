#include "io/video/h264_stream.h"

#include <chrono>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "io/video/ffmpeg.h"
#include "io/video/h264_settings.h"

namespace thermal {
namespace {

using Clock = std::chrono::steady_clock;

/// Timeout for a receiver's answer, and for reading a frame.
constexpr std::chrono::seconds kPatience(5);

/// MPEG-TS packets of 188 bytes, as many as fit an Ethernet frame.
constexpr const char* kWholePackets = "?pkt_size=1316";

ffmpeg::H264Writer::Container container_for(const NetAddress& address) {
  if (address.scheme == "rtsp")
    return {.format = "rtsp", .url = address.url(), .global_header = true, .live = true};
  return {.format = "mpegts", .url = address.url() + kWholePackets, .global_header = false, .live = true};
}

}  // namespace

struct H264Stream::Impl {
  std::string url;
  std::function<bool()> interrupted;
  Clock::time_point give_up = Clock::now() + kPatience;
  bool given_up = false;
  std::function<bool()> must_end = [this] {
    given_up = given_up || Clock::now() > give_up || interrupted();
    return given_up;
  };
  ffmpeg::H264Writer writer;

  Impl(const NetAddress& address, const H264Settings& settings, std::function<bool()> ask)
      : url(address.url()),
        interrupted(std::move(ask)),
        writer(
            container_for(address), settings, [this](int error) { fail(error); }, &must_end) {}

  [[noreturn]] void fail(int error) const {
    throw IoError(fmt::format("cannot send to {}: {}", url, reason_of(error)));
  }

  [[nodiscard]] std::string reason_of(int error) const {
    if (error == AVERROR_ENCODER_NOT_FOUND) return "FFmpeg has no libx264";
    if (!given_up) return ffmpeg::reason_of(error);
    return interrupted() ? "stopped" : fmt::format("no answer within {} s", kPatience.count());
  }

  /// FFmpeg's error codes do not identify a timeout: it may report another error, or none.
  template <typename Send>
  void in_time(const Send& send) {
    give_up = Clock::now() + kPatience;
    send();
    if (given_up) fail(AVERROR_EXIT);
  }
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
  impl_->in_time(
      [&] { impl_->writer.add([&frame](const VideoPlanes& planes) { draw_grey(frame, planes); }, time); });
}

void H264Stream::close() {
  impl_->in_time([this] { impl_->writer.close(); });
}

}  // namespace thermal
