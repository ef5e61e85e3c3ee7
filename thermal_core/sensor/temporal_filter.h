#pragma once

#include <vector>

#include "base/image.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Temporal noise reduction as cameras have it: each pixel is a recursive mean of its frames, with a motion detector. A
/// pixel that has changed by more than noise can explain, alone or as the mean of its 3 x 3 neighbourhood, follows at
/// once. (By the pixel alone, moving texture of a few standard deviations would follow in some pixels and trail in
/// others, which looks like noise.)
///
/// White noise of a still scene keeps share / (2 - share) of its variance: 1/3 for a share of 0.5. Between a new value
/// and the mean, it has a standard deviation of sqrt(2 / (2 - share)) times its own, of which `motion_sigma` are the
/// limit of a pixel, and a third of that the limit of nine. What changes by less trails behind.
class TemporalFilter {
 public:
  /// @param noise_w_m2_sr  standard deviation of a pixel's white noise
  TemporalFilter(const DenoiseParameters& parameters, float noise_w_m2_sr);

  /// The next frame passes unchanged, as the first does: after the shutter, pixels have another offset.
  void restart() noexcept { mean_.clear(); }

  /// Replaces the next frame by the mean. Frames are of one size.
  void apply(Plane<float>& signal_w_m2_sr);

 private:
  void take_changes(const Plane<float>& signal_w_m2_sr);
  void follow_row(int y, Plane<float>& signal_w_m2_sr);

  float share_;
  float limit_w_m2_sr_;
  std::vector<float> mean_;
  Plane<float> change_;  ///< of a frame from the mean
};

}  // namespace thermal
