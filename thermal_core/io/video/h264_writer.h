#pragma once

#include <functional>
#include <string>

#include "io/video/ffmpeg.h"
#include "io/video/h264_settings.h"

namespace thermal::ffmpeg {

/// An H.264 encoder and the container that its packets go to. Faults are FFmpeg's codes, which `fault` turns into
/// exceptions.
class H264Writer {
 public:
  using Fault = std::function<void(int error)>;  ///< throws

  struct Container {
    std::string format;         ///< of FFmpeg: "mp4", "mpegts", "rtsp"
    std::string url;            ///< a file, or where to send
    bool global_header = true;  ///< once, and not with each keyframe
    bool live = false;          ///< each frame leaves at once; a keyframe each second
  };

  /// `interrupted`: asked while FFmpeg waits; true ends the wait. Must outlive this object, as must what it uses.
  H264Writer(Container container, const H264Settings& settings, Fault fault,
             std::function<bool()>* interrupted);

  /// A file that is not closed is none; a stream ends, and its connection with it.
  ~H264Writer();
  H264Writer(const H264Writer&) = delete;
  H264Writer& operator=(const H264Writer&) = delete;

  /// The next frame, which `draw` fills in. `time`: in frames since the first; later than the one before.
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
  bool connected_ = false;  ///< a stream that FFmpeg must end
};

}  // namespace thermal::ffmpeg
