#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/image.h"
#include "io/net/address.h"

namespace thermal {

/// Where the frames of a FrameStream go.
struct StreamTarget {
  NetAddress video;                      ///< udp or rtsp
  std::optional<NetAddress> lines = {};  ///< udp or tcp
  double frame_rate_hz = 9;              ///< > 0
  int width_px = 0;
  int height_px = 0;
};

/// parse_address() with the schemes that a stream's video may have: udp and rtsp.
[[nodiscard]] NetAddress parse_video_address(const std::string& url, const std::string& where);
/// The same for its lines: tcp and udp.
[[nodiscard]] NetAddress parse_line_address(const std::string& url, const std::string& where);

/// Sends frames as video, and a line of text with each, on a thread of its own: whoever makes frames never waits. If more
/// than a few wait to be sent, the next is dropped. If the receiver of the video goes away, frames are dropped while the
/// stream tries each second to reach it again; lines are sent nevertheless.
class FrameStream {
 public:
  struct Counts {
    std::int64_t sent = 0;
    std::int64_t dropped = 0;       ///< no room, or no receiver
    std::int64_t lines_missed = 0;  ///< LineSender::Counts::missed
    std::string fault = {};         ///< why the last frame without a receiver had none; stays
  };

  /// IoError as of H264Stream and LineSender.
  explicit FrameStream(const StreamTarget& target);
  /// Sends nothing more; close() does.
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  /// Hands over a frame, which is copied, and its line. `time`: in frames since the stream's begin; later than that of the
  /// frame before. False if it is dropped because there is no room. ConfigError for another size than the target's.
  bool send(const Plane<std::uint8_t>& frame, std::int64_t time, std::string line);

  /// Sends what waits, two seconds at most, and ends the stream.
  void close();

  [[nodiscard]] Counts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermal
