#include "dataset/stream/lateness.h"

#include <algorithm>
#include <cmath>

#include "base/nearest_rank.h"

namespace thermal {

int frames_to_leave_out(double late_s, double frame_rate_hz) noexcept {
  return std::max(0, static_cast<int>(std::floor(late_s * frame_rate_hz)) - 1);
}

Lateness lateness_of(std::vector<double> late_s) {
  if (late_s.empty()) return {};
  std::ranges::sort(late_s);
  return {
      .median_s = nearest_rank(late_s, 0.5), .high_s = nearest_rank(late_s, 0.95), .most_s = late_s.back()};
}

}  // namespace thermal
