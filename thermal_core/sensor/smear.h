#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/image.h"

namespace thermal {

/// How far each pixel's part of the picture moved within a frame interval [px], to the right and down. Empty planes:
/// nothing moved, or the motion is unknown.
struct ImageMotion {
  Plane<float> x_px;
  Plane<float> y_px;

  [[nodiscard]] bool empty() const noexcept { return x_px.empty(); }
};

/// A sample that a smeared pixel is mixed from: where, relative to it, and its weight.
struct SmearTap {
  int x_px = 0;
  int y_px = 0;
  float weight = 0;
};

/// The samples of a pixel whose part of the picture moved by x_px, y_px during `ages` time constants; sum of weights 1.
/// Finite motion, ages > 0. `begins` shifts them all by this share of the motion: 0 if the pixel is read at the picture's
/// time, below 0 if later.
[[nodiscard]] std::vector<SmearTap> smear_taps(double x_px, double y_px, double ages, double begins = 0);

/// Smear of a moving picture within a frame interval. A pixel's membrane weights what it received at an age t by
/// exp(-t / tau) / tau, and what it sees now at x + v t it received at x at that age, v being its part's motion. This
/// mixes the ages within the last interval, weights renormalised to 1:
///   smeared(x) = integral from 0 to T of exp(-t / tau) / (tau (1 - exp(-T / tau))) picture(x + v t) dt.
/// Thermal lag from frame to frame, S_n = (1 - a) smeared_n + a S_(n-1) with a = exp(-T / tau), then makes the rest:
/// under constant motion the n-th smeared picture before is this one moved by n v T, the weights (1 - a) a^n exp(-t /
/// tau) / (tau (1 - a)) are exp(-(t + n T) / tau) / tau, and the sum is the membrane's integral over all ages.
///
/// Each pixel gathers along its own motion, from this picture alone: what something hid within the interval is unknown.
/// Between pixels the picture is interpolated by 6 x 6 samples, best at low frequencies: samples of one picture do not
/// tell how what is near Nyquist moves. smear_test.cpp has the errors. Beyond the edges the picture goes on as it ends.
/// Rows that are read one after the other see the picture of their own time, half of the readout before the frame's to
/// half after it; in steps of 1/64 of an interval.
/// No result is below the coldest pixel that it was mixed from. Motions are rounded to 1/16 px within the reach, which is
/// the longer of the time constant and half of the readout, but at most an interval. Those below 1/64 px within it leave
/// a pixel as it is. Motion of more than 40 px an interval takes up to a hundred times longer.
class Smear {
 public:
  /// @param interval_s  a frame interval, > 0
  /// @param time_constant_s  > 0
  /// @param readout_s  from the first row to the last, from 0 to an interval
  Smear(double interval_s, double time_constant_s, double readout_s = 0);

  /// Of a frame with frames before it.
  void apply(const ImageMotion& motion, Plane<float>& picture);

  /// Of a first frame, as if all had always moved as it does now: over 8 time constants at least.
  void apply_to_first(const ImageMotion& motion, Plane<float>& picture);

 private:
  /// The samples of a motion, as many as a multiple of four.
  struct Samples {
    std::vector<SmearTap> taps;
    std::vector<float> weights;
    std::vector<std::ptrdiff_t> offsets;  ///< of the samples in the picture, from that at the same place
    int left_px = 0;                      ///< how far they reach
    int right_px = 0;
    int up_px = 0;
    int down_px = 0;
  };
  /// Pixels with one motion.
  struct Piece {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    std::int64_t motion = 0;  ///< in steps, both axes and the time of reading in one number
    const Samples* samples = nullptr;
  };
  class Cutter;

  void apply(const ImageMotion& motion, Plane<float>& picture, double ages, double intervals);
  void find_samples(double ages, double intervals);
  [[nodiscard]] Samples samples_of(std::int64_t motion, double ages, double intervals) const;
  void mix(const Piece& piece, Plane<float>& picture) const;
  void mix_far(const Piece& piece, Plane<float>& picture) const;

  double ages_;                             ///< a frame interval, in time constants
  double readout_;                          ///< in intervals
  double reach_;                            ///< in intervals: how far from the frame's time most samples lie
  Plane<float> sharp_;                      ///< with a margin
  std::vector<std::vector<Piece>> pieces_;  ///< by row of tiles
  std::unordered_map<std::int64_t, Samples>
      samples_;  ///< of motions that were seen, but for the first frame's
};

}  // namespace thermal
