#pragma once

#include <cstdint>
#include <memory>

#include "base/image.h"
#include "io/files.h"

namespace thermal {

/// Writes an H.264 video to look at, frame by frame. Lossy, and not among the pixels that are hashed.
class PreviewVideo {
 public:
  /// IoError if the file or the encoder cannot be opened, TryAgainError if the disk is full.
  PreviewVideo(const Path& file, double frame_rate_hz, int width_px, int height_px);
  ~PreviewVideo();
  PreviewVideo(PreviewVideo&&) noexcept;
  PreviewVideo& operator=(PreviewVideo&&) noexcept;

  void add(const Plane<std::uint8_t>& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermal
