#pragma once

#include <functional>
#include <string>

#include "io/video/ffmpeg.h"
#include "io/video/h264_settings.h"

namespace thermal::ffmpeg {

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
