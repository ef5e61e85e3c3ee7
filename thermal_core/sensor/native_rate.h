#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace thermal {

/// The frames that a sensor makes, every `step`-th of which is a frame of the video.
struct NativeRate {
  std::uint32_t step = 1;
  double rate_hz = 0;  ///< step times the video's rate

  /// @param native_rate_hz  the sensor's; 0: the video's. The step is the nearest one, so that the rate may differ:
  ///   a video of 9 Hz from a sensor of 60 Hz is every seventh frame at 63 Hz.
  [[nodiscard]] static NativeRate of(double native_rate_hz, double video_rate_hz) noexcept {
    constexpr double kRounding = 1e-12;  // of a quotient of decimals, or of a rate such as 60 / 7
    constexpr double kMostFrames = 1e6;
    const double step = std::round(std::clamp(native_rate_hz / video_rate_hz, 1.0, kMostFrames));
    const double rate_hz = step * video_rate_hz;
    const bool equal = std::abs(rate_hz - native_rate_hz) <= kRounding * native_rate_hz;
    return {.step = static_cast<std::uint32_t>(step), .rate_hz = equal ? native_rate_hz : rate_hz};
  }
};

}  // namespace thermal
