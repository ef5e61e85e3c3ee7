#pragma once

#include <functional>
#include <string>
#include <vector>

namespace thermal {

/// A figure of a stage: its error or composition; the name includes the unit.
struct Figure {
  std::string name;
  double value = 0;
};

/// Cost of one sensor stage for a 640 x 512 frame, and its deviation from its specification.
struct StageRow {
  std::string group;  ///< rows of one group do the same work
  std::string name;
  std::vector<Figure> figures;
  double ms_per_frame = 0;  ///< one thread
  double times_memcpy = 0;  ///< against copying the bytes that a frame reads and writes; 0: not compared
};

/// Times `frame`, the stage's work on one frame. The row's figures were measured before.
/// @param bytes_per_pixel  read and written per frame; 0: not compared with memcpy
[[nodiscard]] StageRow timed(StageRow row, std::size_t bytes_per_pixel, const std::function<void()>& frame);

/// Difference of a mean square of `count` independent normal values from the specified variance, in standard errors
/// of variance sqrt(2 / count).
[[nodiscard]] double variance_sigma(double mean_square, double variance, double count);

}  // namespace thermal
