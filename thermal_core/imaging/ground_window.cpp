#include "imaging/ground_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace thermal {
namespace {

constexpr double kMarginCells = 4;

/// Bounds of the ground seen so far [m].
struct Seen {
  std::array<double, 2> low = {std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity()};
  std::array<double, 2> high = {-std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
};

/// Adds the intersections of a ray from the camera with the planes of the lowest and the highest ground. False if it
/// goes up, or is so nearly level that it meets them far away.
bool add_ray(const std::array<double, 16>& pose, double x, double y, double lowest_m, double highest_m,
             Seen& seen) {
  constexpr double kLeastDown = 0.02;
  const auto along = [&](std::size_t row) {
    return pose[4 * row] * x + pose[4 * row + 1] * y + pose[4 * row + 2];
  };
  const double down = -along(2) / std::sqrt(x * x + y * y + 1);
  if (!(down > kLeastDown)) return false;
  for (const double height_m : {lowest_m, highest_m}) {
    const double depth = std::max(0.0, (height_m - pose[11]) / along(2));
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double place_m = pose[4 * axis + 3] + depth * along(axis);
      seen.low[axis] = std::min(seen.low[axis], place_m);
      seen.high[axis] = std::max(seen.high[axis], place_m);
    }
  }
  return true;
}

/// Range of cells, first and count, that covers an interval along an axis.
std::array<std::size_t, 2> cells_of(const GroundMaps& maps, double low_m, double high_m) {
  const double per_m = static_cast<double>(maps.cells) / maps.size_m;
  const auto last = static_cast<double>(maps.cells) - 1;
  const double first = std::clamp(std::floor((low_m + maps.size_m / 2) * per_m) - kMarginCells, 0.0, last);
  const double end = std::clamp(std::ceil((high_m + maps.size_m / 2) * per_m) + kMarginCells, first, last);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(end - first) + 1};
}

}  // namespace

GroundWindow window_of(const GroundMaps& maps, const Manifest& manifest) {
  const GroundWindow all = {.width = maps.cells, .height = maps.cells};
  if (manifest.frames.empty() || maps.height_m.empty()) return all;
  const auto [lowest, highest] = std::ranges::minmax_element(maps.height_m);
  const auto lowest_m = static_cast<double>(*lowest);
  const auto highest_m = static_cast<double>(*highest);
  const CameraIntrinsics& camera = manifest.camera;
  // Half a picture more on each side, because distorting lenses and overscan exceed a pinhole's picture.
  const double reach_x = (1.0 * camera.width_px + manifest.overscan_px) / camera.fx_px;
  const double reach_y = (1.0 * camera.height_px + manifest.overscan_px) / camera.fy_px;
  const bool distorted = !manifest.lens.is_none() || manifest.overscan_px > 0;
  const double share = distorted ? 1 : 0.55;
  Seen seen;
  for (const ManifestFrame& frame : manifest.frames) {
    if (!frame.camera_to_world) return all;
    for (const double x : {-share, share}) {
      for (const double y : {-share, share}) {
        if (!add_ray(*frame.camera_to_world, x * reach_x, y * reach_y, lowest_m, highest_m, seen)) return all;
      }
    }
  }
  const auto [first_x, width] = cells_of(maps, seen.low[0], seen.high[0]);
  const auto [first_y, height] = cells_of(maps, seen.low[1], seen.high[1]);
  return {.first_x = first_x, .first_y = first_y, .width = width, .height = height};
}

}  // namespace thermal
