#pragma once

#include <array>
#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
}

/// Shared by the modules here. Only their sources may include it: FFmpeg is private to them.
namespace thermal::ffmpeg {

/// Log level below all of FFmpeg's; errors are reported by exceptions.
inline constexpr int kSilent = 100;

/// Chroma has half the size, so sides are even; a picture of odd size repeats its edge.
constexpr int even(int size_px) { return size_px + size_px % 2; }

inline std::string reason_of(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  return av_make_error_string(text.data(), text.size(), error);
}

struct FreeFormat {
  void operator()(AVFormatContext* format) const {
    if (format->pb != nullptr) avio_closep(&format->pb);
    avformat_free_context(format);
  }
};
struct FreeCodec {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
};
struct FreePicture {
  void operator()(AVFrame* picture) const { av_frame_free(&picture); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

using Format = std::unique_ptr<AVFormatContext, FreeFormat>;
using Codec = std::unique_ptr<AVCodecContext, FreeCodec>;
using Picture = std::unique_ptr<AVFrame, FreePicture>;
using Packet = std::unique_ptr<AVPacket, FreePacket>;

}  // namespace thermal::ffmpeg
