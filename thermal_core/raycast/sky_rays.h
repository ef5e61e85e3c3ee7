#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "raycast/sight.h"

namespace thermal {

/// Directions above the horizon, distributed as the cosine from the vertical: their projections onto the unit disc are
/// spread evenly. The share of them that is not blocked estimates the sky view.
///
/// The set is a lattice in (u, v) = (sine of the angle from the vertical, squared; azimuth in turns), of k / n and
/// frac(k g / n) with consecutive Fibonacci numbers g and n. A lane shifts it by a vector of the lattice's own cell, so
/// that direction k of all lanes lies in one cell: rays of a packet stay together, and errors of cells are independent
/// of each other. Bits do not depend on the C library: only +, -, *, / and square roots.
class SkyRays {
 public:
  /// @param count  a Fibonacci number from 8 to 2584
  explicit SkyRays(std::size_t count);

  [[nodiscard]] std::size_t count() const noexcept { return points_.size(); }

  /// Shift of each lane within the lattice's cell, from 0 to less than 1 along both sides.
  using Shift = std::array<Lanes<float>, 2>;

  /// Direction k of each lane: unit vectors.
  [[nodiscard]] VectorLanes<float> at(std::size_t k, const Shift& shift) const noexcept;

 private:
  struct Point {
    float u = 0;
    float v = 0;
  };

  std::vector<Point> points_;
  std::array<Point, 2> sides_;                ///< of the lattice's cell
  std::vector<std::array<float, 2>> circle_;  ///< unit vectors, by azimuth
};

}  // namespace thermal
