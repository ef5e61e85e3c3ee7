#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "base/image.h"
#include "io/system/files.h"
#include "io/video/h264_settings.h"

namespace thermal {

/// Writes an H.264 video (MP4) of 8-bit YUV 4:2:0 frames, levels 16 to 235 (ITU-R BT.601).
class H264File {
 public:
  using Planes = VideoPlanes;

  /// IoError if the file or the encoder cannot be opened, TryAgainError if the disk is full.
  H264File(const Path& file, const H264Settings& settings);
  ~H264File();
  H264File(H264File&&) noexcept;
  H264File& operator=(H264File&&) noexcept;

  /// The next frame, which `draw` fills in. Faults as of the constructor.
  void add(const std::function<void(const Planes&)>& draw);

  /// Completes the file. Faults as the constructor.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// For programs, since it changes the whole process: FFmpeg prints no messages of its own from here on. Exceptions
/// report what goes wrong. Without it, the writer of MP4 files prints a line for each streamable file.
void silence_ffmpeg() noexcept;

/// Writes an H.264 preview (MP4), frame by frame. Lossy, and not part of the hashed pixels; yet its bytes depend on the
/// frames and the encoder's version alone, not on the number of cores.
class PreviewVideo {
 public:
  /// @param frame_rate_hz  > 0
  /// IoError if the file or the encoder cannot be opened, TryAgainError if the disk is full.
  PreviewVideo(const Path& file, double frame_rate_hz, int width_px, int height_px);

  /// The next frame, of the constructor's size. Faults as the constructor.
  void add(const Plane<std::uint8_t>& frame);

  /// Completes the file. Faults as the constructor.
  void close();

 private:
  H264File file_;
};

}  // namespace thermal
