#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/rng.h"

namespace thermal {

/// A first-order autoregressive process, updated at ticks and constant in between. With a random phase of its ticks it
/// is stationary: its autocorrelation is keep^m at m periods, linear from one period to the next.
struct FlickerProcess {
  std::uint32_t period_frames = 1;  ///< native frames from tick to tick, a power of two
  double keep = 0;                  ///< correlation from tick to tick
  double variance = 0;
};

/// White noise plus 1/f noise as a sum: one normal number in each frame, and a few slow processes. The processes have
/// corners a factor of 4 or less apart, from 1e-3 Hz to 0.8 of the knee, or to a third of Nyquist if that is lower, and
/// tick 1.25 to 2.5 times in their time constant. The 1/f noise above them is small beside the white noise and is added
/// to its variance.
///
/// Why ticks and no filter in every frame: a slow video of a fast sensor then needs as few normal numbers a second as
/// any other (6 a pixel at a knee of 0.5 Hz), and a frame is the same whichever frames are requested. Why constant
/// between ticks and not linear: the variance is then the same in every frame. A step is a tenth of the white noise.
struct FlickerDesign {
  std::vector<FlickerProcess> processes;  ///< the fastest first, every period a multiple of those before it
  double white_variance = 0;              ///< of the rest, in each frame

  /// Scaled to (2 / rate) (1 Hz / f), which at 1 Hz equals the spectrum of white noise of variance 1. Minimises the
  /// squared relative error of (1 + knee / f), evenly in log frequency from 3e-3 Hz to Nyquist. That sum is within 0.5
  /// dB there, at rates of 9 Hz and knees of 0.01 Hz and more. Requires rate_hz > 0, knee_hz > 0.
  [[nodiscard]] static FlickerDesign fit(double rate_hz, double knee_hz);

  /// Power spectral density at a frequency, one-sided [1/Hz], `white_variance` included; exact for uniformly
  /// distributed phases. Frequency in (0, rate / 2].
  [[nodiscard]] double density(double frequency_hz, double rate_hz) const;

  /// Variance in every frame, `white_variance` included.
  [[nodiscard]] double variance() const noexcept;
};

/// 1/f noise of every pixel over time: the processes of a design, without its white part. A frame is a function of
/// (seed, clip, frame) and of the last restart alone, whichever frames are requested. It is stationary from the first
/// frame on. Blocks of pixels tick at random phases, so that all frames cost the same.
class FlickerNoise {
 public:
  static constexpr std::size_t kBlockPixels = 256;

  FlickerNoise(std::uint32_t seed, std::string_view clip, const FlickerDesign& design, std::size_t pixels);

  /// Restarts at a frame, independent of all before it: as after a shutter closing, which measures and removes each
  /// pixel's accumulated offset. `event` numbers the closing; each has its own random numbers. Event 0 begins at frame
  /// 0 without a call.
  void restart_at(std::uint32_t frame, std::uint32_t event);

  /// Advances pixels [first, first + out.size()) to a frame and adds `stddev` times the noise. `first` is a multiple of
  /// kBlockPixels. Frame numbers must not decrease; gaps cost their ticks alone. Safe to call from several threads on
  /// different pixels.
  void add(std::uint32_t frame, std::size_t first, float stddev, std::span<float> out);

 private:
  [[nodiscard]] float* state(std::size_t block, std::size_t process) noexcept;
  void start(std::size_t block);
  void sum_slow(std::size_t block);
  void tick(std::size_t block, std::uint64_t tick);
  void advance(std::size_t block, std::uint32_t frame);

  RandomField field_;
  FlickerDesign design_;
  std::uint64_t period_ = 1;  ///< of the fastest process
  std::uint32_t begins_ = 0;
  std::uint32_t event_ = 0;
  std::vector<std::uint32_t> phases_;  ///< by block: native frames from a tick of all processes to frame 0
  std::vector<std::uint64_t> ticks_;   ///< by block: last tick of the fastest process, or none
  std::vector<float> states_;          ///< by block, process and pixel
  std::vector<float> slow_;            ///< by pixel: sum of all processes but the fastest
  std::vector<float> sums_;  ///< by pixel: sum of all processes, which add() adds until the next tick
};

}  // namespace thermal
