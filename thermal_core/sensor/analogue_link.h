#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "sensor/convolution.h"
#include "sensor/smear.h"

namespace thermal {

/// How a recorder makes frames of two fields, the even and the odd rows.
enum class Deinterlace {
  weave,  ///< as they come: what moves is combed
  bob,    ///< the even rows, and means of two of them between
  blend   ///< each row averaged with its neighbours, 1 : 2 : 1
};

/// See AnalogueLink. Levels are those of 8-bit frames; all standard deviations.
struct AnalogueLinkParameters {
  double field_rate_hz = 50;   ///< PAL: 50, NTSC: 60 / 1.001
  double active_line_us = 52;  ///< what a row of the picture takes. PAL: 52, NTSC: 52.66
  double bandwidth_mhz = 5;    ///< at which half of the amplitude is left
  Deinterlace deinterlace = Deinterlace::weave;
  double noise_levels = 0;    ///< of a pixel, white, ahead of the bandwidth
  double streak_levels = 0;   ///< of noise that is correlated along a row by exp(-t / streak_us)
  double streak_us = 1;       ///< > 0
  double row_levels = 0;      ///< of each row by itself
  double drift_levels = 0;    ///< of rows, from one to the next of a field correlated by exp(-1 / drift_rows)
  double drift_rows = 40;     ///< > 0
  double hum_levels = 0;      ///< of a sine of the mains
  double hum_hz = 50;         ///< of the mains
  double jitter_px = 0;       ///< of each row's place
  double dropouts_per_s = 0;  ///< pieces of rows that are black or white, at most 1000
  double dropout_us = 4;      ///< their mean length; exponentially distributed

  [[nodiscard]] bool operator==(const AnalogueLinkParameters&) const = default;
};

/// An analogue video link from the camera to a recorder, interlaced: what night footage of the 2010s passed through. A
/// frame's rows are the lines of the picture (no raster of 576 or 480 lines lies between), its two fields are half a field
/// ahead of the frame's time and half a field behind: what moves by v pixels a frame interval T is combed by v / (T x
/// field rate). In this order: fields, noise and streaks, bandwidth, level errors, jitter, dropouts, frames of fields. Bandwidth is a
/// Gaussian along rows, exp(-ln 2 (f / bandwidth)^2), within 0.015. Pixels are a function of the parameters, the clip,
/// the number of the frame and its picture.
class AnalogueLink {
 public:
  /// What a link's errors depend on.
  struct Clip {
    std::uint32_t seed = 1;
    std::string_view id;
    double frame_rate_hz = 9;
    int width_px = 0;
    int height_px = 0;
  };

  AnalogueLink(const AnalogueLinkParameters& parameters, const Clip& clip);

  /// Replaces the next frame by what the recorder has. `motion` may be empty: then nothing is combed.
  void pass(const ImageMotion& motion, Plane<std::uint8_t>& picture);

  /// Advances the clock past a frame that is unknown.
  void skip() noexcept { ++frame_; }

 private:
  [[nodiscard]] std::vector<float> normals(std::uint32_t stream, std::uint32_t frame, std::size_t first,
                                           std::size_t count) const;
  void draw_rows(std::uint32_t frame);
  void scan(const ImageMotion& motion, const Plane<std::uint8_t>& picture, int y,
            std::vector<float>& row) const;
  void send(std::uint32_t frame, int y, std::vector<float>& row, std::vector<float>& buffer);
  void drop(std::uint32_t frame);
  [[nodiscard]] float received(int x, int y) const;

  AnalogueLinkParameters parameters_;
  std::uint32_t seed_;
  std::uint64_t clip_;
  double frame_rate_hz_;
  int width_px_;
  int height_px_;
  HalfKernel bandwidth_;
  double hum_turns_;  ///< at the clip's beginning
  std::uint32_t frame_ = 0;
  std::vector<float> row_levels_;  ///< errors of this frame's rows …
  std::vector<float> row_px_;      ///< … and how far they are to the right
  Plane<float> signal_;
};

}  // namespace thermal
