#include "bench/stage_row.h"

#include <cmath>
#include <utility>

#include "bench/measure.h"
#include "bench/sensor_scene.h"

namespace thermal {

StageRow timed(StageRow row, std::size_t bytes_per_pixel, const std::function<void()>& frame) {
  constexpr double kStageBudgetS = 0.2;
  constexpr double kMemcpyBudgetS = 0.05;  // tenths of a millisecond each
  const double seconds = shortest_run_s(frame, kStageBudgetS);
  row.ms_per_frame = 1e3 * seconds;
  if (bytes_per_pixel > 0)
    row.times_memcpy = seconds / memcpy_s(bytes_per_pixel * kScenePixels, kMemcpyBudgetS);
  return row;
}

double variance_sigma(double mean_square, double variance, double count) {
  return (mean_square / variance - 1) / std::sqrt(2 / count);
}

}  // namespace thermal
