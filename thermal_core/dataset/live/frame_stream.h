#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "io/net/address.h"

namespace thermal {

/// Number of frames that a camera `late_s` behind its clock skips, so that the next one is late by less than a frame.
[[nodiscard]] int frames_to_leave_out(double late_s, double frame_rate_hz) noexcept;

/// Lateness of frames, from their due time until they are queued [s].
struct Lateness {
  double median_s = 0;
  double high_s = 0;  ///< 95th percentile
  double most_s = 0;
};

/// Statistics of the frames' lateness; 0 without frames.
[[nodiscard]] Lateness lateness_of(std::vector<double> late_s);

/// Destination of a FrameStream.
struct StreamTarget {
  NetAddress video;                      ///< udp or rtsp
  std::optional<NetAddress> lines = {};  ///< udp or tcp
  double frame_rate_hz = 9;              ///< 0.1 to 240
  int width_px = 0;                      ///< 1 to 8192
  int height_px = 0;
};

/// parse_address() with the schemes that a stream's video may have: udp and rtsp.
[[nodiscard]] NetAddress parse_video_address(const std::string& url, const std::string& where);
/// The same for its lines: tcp and udp.
[[nodiscard]] NetAddress parse_line_address(const std::string& url, const std::string& where);

/// ConfigError with `where` unless a stream may have this rate: 0.1 to 240 Hz.
void check_frame_rate(double frame_rate_hz, const std::string& where);

/// Sends frames as video, and a line of text with each, on a separate thread, without ever blocking the caller. If more
/// than a few are queued, the next is dropped. If the receiver of the video goes away, or does not read for 5 s, frames
/// are dropped while the stream reconnects each second. Lines are sent at once, independently of the video.
class FrameStream {
 public:
  struct Counts {
    std::int64_t sent = 0;
    std::int64_t dropped = 0;          ///< queue full, or no receiver
    std::int64_t waiting = 0;          ///< queued; at most a few
    std::int64_t lines_missed = 0;     ///< LineSender::Counts::missed
    std::int64_t clients_refused = 0;  ///< LineSender::Counts::refused
    std::string fault = {};            ///< why the last frame without a receiver had none; kept
  };

  /// `stopped`: called until the receiver has answered; true ends the wait with an IoError. ConfigError for a rate or
  /// size out of range; IoError as H264Stream and LineSender.
  explicit FrameStream(const StreamTarget& target, std::function<bool()> stopped = {});
  /// Discards queued frames; close() sends them.
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  /// Queues a copy of a frame, and its line. `time`: in frames since the stream's start; increasing. False if the frame
  /// is dropped because the queue is full; its line is sent nevertheless. ConfigError for a size other than the
  /// target's.
  bool send(const Plane<std::uint8_t>& frame, std::int64_t time, std::string_view line);

  /// Sends queued frames for at most two seconds, and ends the stream.
  void close();

  [[nodiscard]] Counts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermal
