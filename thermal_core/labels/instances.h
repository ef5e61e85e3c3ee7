#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/image.h"
#include "labels/rle.h"

namespace thermal {

/// Whole pixels [x, x + width) x [y, y + height), 0-based from the top left.
struct PixelBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  [[nodiscard]] bool operator==(const PixelBox&) const = default;
};

/// One actor in one frame: exactly the pixels that carry its index.
struct Instance {
  std::uint16_t index = 0;
  PixelBox box;               ///< the smallest that holds all its pixels
  std::uint32_t area_px = 0;  ///< number of its pixels
  bool truncated = false;     ///< it touches the border of the frame
  RunLengths mask;            ///< over the whole frame, column-major
};

/// Where an index first occurs, in row-major order, and how often.
struct IndexUse {
  std::uint16_t index = 0;
  int first_x_px = 0;
  int first_y_px = 0;
  std::uint32_t pixels = 0;
  PixelBox box;
};

/// Every index of a plane with its extent, by rising index, in one pass over the plane.
/// Indices are at most 32767.
[[nodiscard]] std::vector<IndexUse> survey_indices(const Plane<std::uint16_t>& index_plane);

/// The actors among `uses`, in that order, with their masks. A pixel outside an actor's box is never read
/// again, so the cost is one pass over the plane plus the actors' boxes.
[[nodiscard]] std::vector<Instance> extract_instances(const Plane<std::uint16_t>& index_plane,
                                                      std::span<const IndexUse> uses,
                                                      std::span<const std::uint16_t> actor_indices);

}  // namespace thermal
