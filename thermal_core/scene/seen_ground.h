#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "scene/baked_scene.h"
#include "scene/camera_model.h"
#include "scene/ground_maps.h"

namespace thermal {

/// A camera's full view, beyond a pinhole's picture too, and its poses.
struct GroundView {
  CameraIntrinsics camera;
  std::vector<std::array<double, 16>> camera_to_world;  ///< row-major 4 x 4, OpenCV camera axes
};

/// Cells along a side of the blocks into which maps are cut.
inline constexpr std::size_t kBlockCells = 4;

/// Blocks along a side of maps; the last ones may be cut off.
[[nodiscard]] inline std::size_t blocks_along(std::size_t cells) noexcept {
  return (cells + kBlockCells - 1) / kBlockCells;
}

/// Per block of cells, [row of y, column of x]: the width on the ground [m] of the finest pixel that may use one of its
/// values, also mirrored by water; infinite where there is none. Pixels use cells within a few pixels and 4 cells of
/// what they show, because values are interpolated and averaged. Occlusion is ignored.
/// @param maps  with heights
[[nodiscard]] std::vector<float> finest_pixels_m(const BakedScene& scene, const GroundMaps& maps,
                                                 std::span<const GroundView> views);

}  // namespace thermal
