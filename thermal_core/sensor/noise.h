#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/rng.h"

namespace thermal {

/// 1/f noise of every pixel over time: a sum of Ornstein-Uhlenbeck processes of equal variance with corner
/// frequencies a decade apart, 1e-3 to 10 Hz, whose spectrum follows 1/f between them with a ripple of about
/// half a decibel. Each process is stepped exactly and starts from its stationary distribution, so the first
/// frame is like any other. A frame is a function of (seed, clip, frame) and of the frames before it.
class FlickerNoise {
 public:
  /// Standard deviation 1. Requires frame_rate_hz > 0.
  FlickerNoise(std::uint32_t seed, std::string_view clip, double frame_rate_hz, int width_px, int height_px);

  /// Steps to the next frame and adds `stddev` times the noise to the picture.
  void add_next(float stddev, Plane<float>& picture);

 private:
  RandomField field_;
  double frame_interval_s_;
  std::vector<Plane<float>> processes_;
};

/// Adds white Gaussian noise of this standard deviation; a function of (seed, clip, frame, pixel).
void add_white_noise(std::uint32_t seed, std::string_view clip, std::uint32_t frame, float stddev,
                     Plane<float>& picture);

/// Uniform in [-1, 1) for each pixel, the same for all frames of a clip.
[[nodiscard]] Plane<float> fixed_pattern(std::uint32_t seed, std::string_view clip, int width_px,
                                         int height_px);

}  // namespace thermal
