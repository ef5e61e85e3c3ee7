#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/rng.h"

namespace thermal {

/// Independent Ornstein-Uhlenbeck processes with a spectrum near 1/f in sum: the reference for the sensor's cheaper
/// filter. Corners are evenly spaced in log frequency from 1e-3 Hz to a third of Nyquist, variances fitted (least
/// squares of the relative error from 3e-3 Hz to Nyquist). Sampled exactly.
struct OuBank {
  std::vector<double> decays;  ///< from frame to frame
  std::vector<double> variances;

  /// Scaled to (2 / rate) (1 Hz / f), as FlickerFilter. Requires rate_hz > 0; 2 <= processes <= 8 keeps all
  /// variances positive at 30 Hz.
  [[nodiscard]] static OuBank design(double rate_hz, int processes);

  /// Power spectral density, one-sided [1/Hz].
  [[nodiscard]] double density(double frequency_hz, double rate_hz) const;

  [[nodiscard]] double variance() const;
};

/// The bank's noise of every pixel over time, started from the stationary distribution.
class OuNoise {
 public:
  OuNoise(std::uint32_t seed, std::string_view clip, OuBank bank, std::size_t pixels);

  /// Steps all pixels to the next frame and adds the noise. Frames count from 0.
  void add_next(std::uint32_t frame, std::span<float> out);

 private:
  RandomField field_;
  OuBank bank_;
  std::vector<std::vector<float>> states_;  ///< by process, each of variance 1
};

}  // namespace thermal
