#pragma once

#include <cstdint>

#include "base/image.h"
#include "io/video/h264_file.h"

namespace thermal {

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
