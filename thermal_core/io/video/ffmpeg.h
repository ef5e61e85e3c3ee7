#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "io/video/h264_settings.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
}

namespace thermal::ffmpeg {

// Shared by the modules here. Only their sources may include it: FFmpeg is private to them.

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

/// An H.264 encoder and its container. Faults are FFmpeg's codes, which `fault` turns into exceptions.
class H264Writer {
 public:
  using Fault = std::function<void(int error)>;  ///< throws

  struct Container {
    std::string format;         ///< of FFmpeg: "mp4", "mpegts", "rtsp"
    std::string url;            ///< a file, or a destination
    bool global_header = true;  ///< once, instead of with each keyframe
    bool live = false;          ///< no delay; a keyframe each second
  };

  /// `interrupted`: called while FFmpeg waits; true ends the wait. Must outlive this object, together with its
  /// captures.
  H264Writer(Container container, const H264Settings& settings, Fault fault,
             std::function<bool()>* interrupted);

  /// Without close(), a file is incomplete; a stream ends with its connection.
  ~H264Writer();
  H264Writer(const H264Writer&) = delete;
  H264Writer& operator=(const H264Writer&) = delete;

  /// The next frame, which `draw` fills in. `time`: in frames since the first; increasing.
  void add(const std::function<void(const VideoPlanes&)>& draw, std::int64_t time);

  /// Ends the file or stream.
  void close();

 private:
  void check(int result) const {
    if (result < 0) fault_(result);
  }
  void open_encoder(const H264Settings& settings);
  void open_container(const H264Settings& settings, std::function<bool()>* interrupted);
  void encode(const AVFrame* what);

  Container container_;
  Fault fault_;
  Format format_;
  Codec encoder_;
  Picture picture_{av_frame_alloc()};
  Packet packet_{av_packet_alloc()};
  bool connected_ = false;  ///< a stream that needs FFmpeg to end it
};

}  // namespace thermal::ffmpeg
