#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "io/system/files.h"

namespace thermal {

/// How a video is encoded. Its bytes depend on this, the frames and the encoder's version alone.
struct H264Settings {
  double frame_rate_hz = 9;  ///< > 0
  int width_px = 0;          ///< > 0; an odd side becomes one pixel longer
  int height_px = 0;
  std::string preset = "ultrafast";  ///< of x264
  int quality = 26;                  ///< x264's constant rate factor: 0 without loss, 51 worst
  int threads = 1;  ///< of the encoder: a constant, because the bytes depend on it, never the number of cores
  bool streamable = false;  ///< the index comes first, so that a browser plays while it loads
};

/// Writes an H.264 video (MP4) of 8-bit YUV 4:2:0 frames, levels 16 to 235 (ITU-R BT.601).
class H264File {
 public:
  /// Where the next frame's pixels go: Y, then U and V of half the size each way. Sides are even.
  struct Planes {
    std::array<std::uint8_t*, 3> data{};
    std::array<int, 3> stride_px{};
    int width_px = 0;
    int height_px = 0;
  };

  /// IoError if the file or the encoder cannot be opened, TryAgainError if the disk is full.
  H264File(const Path& file, const H264Settings& settings);
  ~H264File();
  H264File(H264File&&) noexcept;
  H264File& operator=(H264File&&) noexcept;

  /// The next frame, which `draw` fills in. Faults as of the constructor.
  void add(const std::function<void(const Planes&)>& draw);

  /// Ends the file, which is none before. Faults as of the constructor.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// For programs, since it changes the whole process: FFmpeg prints no messages of its own from here on. Exceptions
/// report what goes wrong. Without it, the writer of MP4 files prints a line for each streamable file.
void silence_ffmpeg() noexcept;

}  // namespace thermal
