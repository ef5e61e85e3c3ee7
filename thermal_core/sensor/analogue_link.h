#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/rng.h"
#include "sensor/optics/convolution.h"
#include "sensor/smear.h"

namespace thermal {

/// How a recorder combines two fields, the even and the odd lines, into a frame.
enum class Deinterlace {
  weave,  ///< unchanged: moving objects are combed
  bob,    ///< the even lines, interpolated in between
  blend   ///< each line averaged with its neighbours, 1 : 2 : 1
};

/// See AnalogueLink. Levels are 8-bit; all are standard deviations.
struct AnalogueLinkParameters {
  double field_rate_hz = 50;   ///< PAL: 50, NTSC: 60 / 1.001
  double active_line_us = 52;  ///< active time of a line. PAL: 52, NTSC: 52.66
  int lines = 0;               ///< of the picture. PAL: 576, NTSC: 480; 0: as many as the frame has rows
  double bandwidth_mhz = 5;    ///< where the amplitude falls to a half
  Deinterlace deinterlace = Deinterlace::weave;
  double noise_levels = 0;   ///< of a pixel, white, ahead of the bandwidth
  double streak_levels = 0;  ///< of noise that is correlated along a line by exp(-t / streak_us)
  double streak_us = 1;      ///< > 0
  double row_levels = 0;     ///< of each line, independent
  double drift_levels = 0;   ///< of lines, from one to the next of a field correlated by exp(-1 / drift_rows)
  double drift_rows = 40;    ///< > 0
  double hum_levels = 0;     ///< of a sine of the mains
  double hum_hz = 50;        ///< of the mains
  double jitter_px = 0;      ///< of each line's position
  double dropouts_per_s = 0;  ///< pieces of lines that are black or white, at most 1000
  double dropout_us = 4;      ///< their mean length; exponentially distributed

  [[nodiscard]] bool operator==(const AnalogueLinkParameters&) const = default;
};

/// An interlaced analogue video link from the camera to a recorder, as in night footage of the 2010s. The two fields
/// are half a field before and after the frame's time: motion of v pixels per frame interval T is combed by v / (T x
/// field rate). In this order: the frame's rows become lines of two fields; noise and streaks; bandwidth; level errors;
/// jitter; 8 bits; dropouts; fields become a frame of the original size. Bandwidth is a Gaussian along lines, exp(-ln 2
/// (f / bandwidth)^2), within 0.015. Rows and lines are converted by linear interpolation, which is lossless if there
/// are as many. Pixels are a function of the parameters, the clip, the number of the frame and its picture.
class AnalogueLink {
 public:
  /// Determines a link's errors.
  struct Clip {
    std::uint32_t seed = 1;
    std::string_view id;
    double frame_rate_hz = 9;
    int width_px = 0;
    int height_px = 0;
  };

  AnalogueLink(const AnalogueLinkParameters& parameters, const Clip& clip);

  /// Replaces the next frame by the recorded one. `motion` may be empty: nothing is combed.
  void pass(const ImageMotion& motion, Plane<std::uint8_t>& picture);

  /// The same for one motion to the right of the whole picture, from even lines to odd ones.
  void pass(float field_motion_px, Plane<std::uint8_t>& picture);

  /// Advances the clock past a frame without a picture.
  void skip() noexcept { ++frame_; }

 private:
  using Scan = std::function<void(int line, std::vector<float>& levels)>;

  /// Noise and streaks, see add_noise().
  struct Noise {
    float fresh = 0;
    float carried = 0;
    float follows = 0;
    float first = 0;
  };

  [[nodiscard]] static Noise noise_of(const AnalogueLinkParameters& link, double px_us);
  [[nodiscard]] RandomField field(std::uint32_t stream, std::uint32_t frame) const noexcept;
  [[nodiscard]] std::vector<float> drawn(double deviation, std::uint32_t stream, std::uint32_t frame) const;
  void transmit(const Scan& scan, Plane<std::uint8_t>& picture);
  void draw_lines(std::uint32_t frame);
  void add_noise(std::uint32_t frame, int line, std::vector<float>& levels) const;
  void send(std::uint32_t frame, int line, std::vector<float>& levels);
  void drop(std::uint32_t frame);
  void record(int y, std::span<std::uint8_t> row) const;
  void add_recorded(int line, float weight, std::vector<float>& levels) const;

  AnalogueLinkParameters parameters_;
  std::uint32_t seed_;
  std::uint64_t clip_;
  double frame_rate_hz_;
  int width_px_;
  int height_px_;
  int lines_;
  HalfKernel bandwidth_;
  Noise noise_;
  double hum_turns_;  ///< at the clip's beginning
  std::uint32_t frame_ = 0;
  std::vector<float> line_levels_;   ///< level error of each line of this frame
  std::vector<float> line_streaks_;  ///< initial state of the streaks, in standard deviations
  std::vector<float> line_px_;       ///< shift of each line to the right
  Plane<std::uint8_t> received_;     ///< lines
};

}  // namespace thermal
