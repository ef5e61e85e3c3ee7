#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/image.h"

namespace thermal {

/// A lossy video codec.
struct VideoCodecSettings {
  std::string name = "h264";     ///< h264 (x264, "veryfast"), mpeg4 (MPEG-4 Part 2) or mjpeg (Motion JPEG)
  double bitrate_kbit_s = 4000;  ///< > 0; mean rate, by the encoder's rate control
  double bitrate_at_hz = 0;  ///< the frame rate that it is stated for; others scale it in proportion; 0: any

  [[nodiscard]] bool operator==(const VideoCodecSettings&) const = default;
};

/// Passes the 8-bit frames of one clip through a codec of FFmpeg: encodes each and decodes it at once, as for recorded
/// or transmitted footage. No B frames, no look-ahead; a keyframe a second.
///
/// Grey is luma of YUV 4:2:0 with constant colour, at full range: 0 to 255 are stored unchanged. An odd side is encoded
/// one pixel longer, with its edge repeated, and cropped again.
///
/// One thread encodes and one decodes, so that pixels depend on the settings, the frames and the versions of FFmpeg and
/// x264 alone; x264 chooses no algorithms by processor.
class VideoCodec {
 public:
  /// ConfigError with the key `output.codec` if the installed FFmpeg lacks the codec, or refuses size or bit rate.
  VideoCodec(const VideoCodecSettings& settings, double frame_rate_hz, int width_px, int height_px);
  ~VideoCodec();
  VideoCodec(VideoCodec&&) noexcept;
  VideoCodec& operator=(VideoCodec&&) noexcept;

  /// Replaces the next frame, of the constructor's size, by its decoded version. Returns the bytes of the encoded
  /// frame. IoError if FFmpeg fails.
  std::size_t pass(Plane<std::uint8_t>& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The names of the codecs that the installed FFmpeg encodes and decodes.
[[nodiscard]] std::vector<std::string> installed_video_codecs();

/// ConfigError, as VideoCodec, if this machine cannot encode and decode such frames.
void check_video_codec(const VideoCodecSettings& settings, double frame_rate_hz, int width_px, int height_px);

}  // namespace thermal
