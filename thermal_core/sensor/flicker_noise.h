#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/rng.h"

namespace thermal {

/// The filter that turns white noise into 1/f noise: real poles evenly spaced in log frequency from 1e-3 Hz to a
/// third of Nyquist, a zero between every two of them (Plaszczynski, Fluct. Noise Lett. 7, R1, 2007), and a last zero
/// that keeps the spectrum's level up to Nyquist, where plain poles and zeros would raise it by 1-2 dB. Written as
/// parallel first-order processes driven by the same normal: y = direct n + sum residue_k s_k, s_k <- pole_k s_k + n.
struct FlickerFilter {
  std::vector<double> poles;
  std::vector<double> residues;
  double direct = 0;

  /// Scaled so that white noise of variance 1 gives the spectrum (2 / rate) (1 Hz / f), which at 1 Hz equals that of
  /// white noise of variance 1. Requires frame_rate_hz > 0, poles_per_decade > 0. Error of the slope below 0.005,
  /// ripple +-0.5 dB at one pole per decade, from 3e-3 Hz to 0.7 of Nyquist and +0.8 dB at Nyquist, at rates of 5 Hz
  /// and more (measured by `veldt bench --suite sensor`).
  [[nodiscard]] static FlickerFilter design(double frame_rate_hz, double poles_per_decade = 1);

  /// Power spectral density at a frequency, one-sided [1/Hz]; frequency in (0, rate / 2].
  [[nodiscard]] double density(double frequency_hz, double frame_rate_hz) const;

  /// Variance of the process.
  [[nodiscard]] double variance() const;
};

/// 1/f noise of every pixel over time. Starts from the stationary distribution, so the first frame is statistically
/// like any other. A frame is a function of (seed, clip, frame) and of the frames before it.
class FlickerNoise {
 public:
  FlickerNoise(std::uint32_t seed, std::string_view clip, const FlickerFilter& filter, std::size_t pixels);

  /// Sets the frame at which add_next() is first called, if it is not 0.
  void begin_at(std::uint32_t frame) noexcept { begins_ = frame; }

  /// Begins again at a frame, independent of all before it: as a shutter's closing does, which measures and removes
  /// what each pixel has gathered.
  void restart_at(std::uint32_t frame) noexcept {
    begins_ = frame;
    ++restarts_;
  }

  /// Steps pixels [first, first + out.size()) to their next frame and adds `stddev` times the noise. `first` is a
  /// multiple of kRandomBatch. Safe to call from several threads on different pixels; every pixel must be stepped
  /// once per frame, with `frame` increasing from that of begin_at().
  void add_next(std::uint32_t frame, std::size_t first, float stddev, std::span<float> out);

 private:
  void start(std::size_t first, std::size_t count);

  RandomField field_;
  std::vector<float> poles_;
  std::vector<float> residues_;
  float direct_;
  std::uint32_t begins_ = 0;
  std::uint32_t restarts_ = 0;
  std::vector<double> start_;  ///< Cholesky factor of the states' stationary covariance, lower, row by row
  std::vector<std::vector<float>> states_;  ///< by pole, before the step to the next frame
};

}  // namespace thermal
