#pragma once

#include <vector>

namespace thermal {

/// Frames that a camera which is `late_s` behind its clock leaves out, so that the next one is late by less than a frame.
[[nodiscard]] int frames_to_leave_out(double late_s, double frame_rate_hz) noexcept;

/// How late frames are, from when they are due until they are handed over [s].
struct Lateness {
  double median_s = 0;
  double high_s = 0;  ///< 95 % are at most this late
  double most_s = 0;
};

/// Of the lateness of each frame; 0 without frames.
[[nodiscard]] Lateness lateness_of(std::vector<double> late_s);

}  // namespace thermal
