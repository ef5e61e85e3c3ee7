#pragma once

#include <vector>

namespace thermal {

/// Number of frames that a camera `late_s` behind its clock skips, so that the next one is late by less than a frame.
[[nodiscard]] int frames_to_leave_out(double late_s, double frame_rate_hz) noexcept;

/// Lateness of frames, from their due time until they are queued [s].
struct Lateness {
  double median_s = 0;
  double high_s = 0;  ///< 95th percentile
  double most_s = 0;
};

/// Statistics of the frames' lateness; 0 without frames.
[[nodiscard]] Lateness lateness_of(std::vector<double> late_s);

}  // namespace thermal
