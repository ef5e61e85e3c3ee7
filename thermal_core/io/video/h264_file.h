#pragma once

#include <functional>
#include <memory>

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

}  // namespace thermal
