#pragma once

#include <functional>
#include <string>
#include <vector>

namespace thermal {

/// A figure that says how wrong a stage is, or what it is made of; the name holds the unit.
struct Figure {
  std::string name;
  double value = 0;
};

/// What one stage of the sensor costs a 640 x 512 frame, and how far it is from what it claims.
struct StageRow {
  std::string group;  ///< rows of one group do the same work
  std::string name;
  std::vector<Figure> figures;
  double ms_per_frame = 0;  ///< one thread
  double times_memcpy =
      0;  ///< against copying the bytes that a frame brings in and takes out; 0: not compared
};

/// Times `frame`, the stage's work on one frame. The row's figures were measured before.
/// @param bytes_per_pixel  that a frame brings in and takes out; 0: not compared with memcpy
[[nodiscard]] StageRow timed(StageRow row, std::size_t bytes_per_pixel, const std::function<void()>& frame);

/// How many standard errors a mean square lies off the variance asked for, of `count` independent normal
/// values: the standard error is variance sqrt(2 / count).
[[nodiscard]] double variance_sigma(double mean_square, double variance, double count);

}  // namespace thermal
