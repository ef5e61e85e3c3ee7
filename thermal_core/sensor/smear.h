#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/image.h"

namespace thermal {

/// Motion of the picture at each pixel within a frame interval [px], to the right and down. Empty planes: no motion, or
/// unknown.
struct ImageMotion {
  Plane<float> x_px;
  Plane<float> y_px;

  [[nodiscard]] bool empty() const noexcept { return x_px.empty(); }
};

/// A sample that contributes to a smeared pixel: offset and weight.
struct SmearTap {
  int x_px = 0;
  int y_px = 0;
  float weight = 0;
};

/// The samples of a pixel whose part of the picture moved by x_px, y_px during `ages` time constants; weights sum to 1.
/// Finite motion, ages > 0. `begins` shifts them all by this share of the motion: 0 if the pixel is read at the
/// picture's time, below 0 if later.
[[nodiscard]] std::vector<SmearTap> smear_taps(double x_px, double y_px, double ages, double begins = 0);

/// Smear of a moving picture within a frame interval. A pixel's membrane weights radiance received an age t ago by
/// exp(-t / tau) / tau; at motion v, that radiance is now at x + v t. This integrates over the ages within the last
/// interval, with weights renormalised to 1:
///   smeared(x) = integral from 0 to T of exp(-t / tau) / (tau (1 - exp(-T / tau))) picture(x + v t) dt. Thermal lag
/// from frame to frame, S_n = (1 - a) smeared_n + a S_(n-1) with a = exp(-T / tau), adds older ages: under constant
/// motion the n-th smeared picture before is this one moved by n v T, the weights (1 - a) a^n exp(-t / tau) / (tau (1 -
/// a)) are exp(-(t + n T) / tau) / tau, and the sum is the membrane's integral over all ages.
///
/// Each pixel integrates along its own motion, in this picture alone: background that was hidden within the interval is
/// unknown. The picture is interpolated by 6 x 6 samples, best at low frequencies: one picture's samples do not
/// determine motion near Nyquist. smear_test.cpp has the errors. Edge pixels are replicated beyond the border. With a
/// rolling readout, each row has its own time, from half of the readout before the frame's time to half after it, in
/// steps of 1/64 of an interval.
/// No result is below its coldest sample. Motions are rounded to 1/16 px within the reach, which is the longer of the
/// time constant and half of the readout, but at most an interval. Motion below 1/64 px within it is ignored. Motion of
/// more than 40 px an interval takes up to a hundred times longer.
class Smear {
 public:
  /// @param interval_s  a frame interval, > 0
  /// @param time_constant_s  > 0
  /// @param readout_s  from the first row to the last, from 0 to an interval
  Smear(double interval_s, double time_constant_s, double readout_s = 0);

  /// For a frame with predecessors.
  void apply(const ImageMotion& motion, Plane<float>& picture);

  /// For a first frame, as if the present motion had always lasted: over 8 time constants at least.
  void apply_to_first(const ImageMotion& motion, Plane<float>& picture);

 private:
  /// The samples of a motion, a multiple of four.
  struct Samples {
    std::vector<SmearTap> taps;
    std::vector<float> weights;
    std::vector<std::ptrdiff_t> offsets;  ///< of the samples in the picture, relative to the pixel
    int left_px = 0;                      ///< reach of the samples
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
  double reach_;                            ///< in intervals: extent of most samples around the frame's time
  Plane<float> sharp_;                      ///< with a margin
  std::vector<std::vector<Piece>> pieces_;  ///< by row of tiles
  std::unordered_map<std::int64_t, Samples>
      samples_;  ///< of motions that were seen, but for the first frame's
};

}  // namespace thermal
