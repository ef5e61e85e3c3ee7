#pragma once

#include <vector>

#include "base/image.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Temporal noise reduction as in cameras: each pixel is a recursive mean of its frames, with a motion detector. A
/// pixel whose change exceeds the noise, alone or averaged over its 3 x 3 neighbourhood, takes its new value at once.
/// (With the pixel alone, moving texture of a few standard deviations would trail in some pixels and not in others,
/// which looks like noise.)
///
/// White noise of a still scene keeps share / (2 - share) of its variance: 1/3 for a share of 0.5. The difference of a
/// new value from the mean has sqrt(2 / (2 - share)) times the noise's standard deviation; the limit is `motion_sigma`
/// of these for a pixel and a third of that for nine. Smaller changes trail behind.
class TemporalFilter {
 public:
  /// @param noise_w_m2_sr  standard deviation of a pixel's white noise
  TemporalFilter(const DenoiseParameters& parameters, float noise_w_m2_sr);

  /// Passes the next frame unchanged, as the first: after the shutter, pixels have other offsets.
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
