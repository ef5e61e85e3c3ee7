#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/image.h"
#include "io/net/address.h"

namespace thermal {

/// Sends grey frames as H.264 video: MPEG-TS by `udp`, which needs no receiver, or pushed to a server by `rtsp`. Frames
/// are sent without delay, with a keyframe each second, from which new receivers can start.
class H264Stream {
 public:
  /// @param frame_rate_hz  > 0
  /// @param interrupted  called while the stream waits, on the calling thread: true ends the wait with an IoError
  /// IoError if there is no answer within 5 s, or FFmpeg has no encoder.
  H264Stream(const NetAddress& address, double frame_rate_hz, int width_px, int height_px,
             std::function<bool()> interrupted);
  ~H264Stream();
  H264Stream(const H264Stream&) = delete;
  H264Stream& operator=(const H264Stream&) = delete;

  /// Sends a frame of the constructor's size. `time`: in frames since the first; increasing. Waits for a slow server, 5
  /// s at most. IoError if it is gone; the stream is unusable then.
  void add(const Plane<std::uint8_t>& frame, std::int64_t time);

  /// Ends the stream. IoError as add().
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermal
