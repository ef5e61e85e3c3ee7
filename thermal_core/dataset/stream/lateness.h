#pragma once

#include <vector>

namespace thermal {

/// Frames that a camera which is `late_s` behind its clock leaves out, so that the next one is late by less than a frame.
[[nodiscard]] int frames_to_leave_out(double late_s, double frame_rate_hz) noexcept;

/// How late frames are, from when they are due until they are handed over [s]: half, 95 % and all are at most this late. 0
/// without frames.
struct Lateness {
  double median_s = 0;
  double high_s = 0;
  double most_s = 0;
};
[[nodiscard]] Lateness lateness_of(std::vector<double> late_s);

}  // namespace thermal
