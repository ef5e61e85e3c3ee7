#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "raycast/pixel_rays.h"
#include "raycast/scene_accelerator.h"
#include "scene/passes.h"

namespace thermal {

/// Pixels whose samples may show any of these pieces are 1. A piece's box is projected and widened by a pixel, so no
/// piece is missed, however small. With a lens, or a box that reaches the camera's plane: all pixels.
[[nodiscard]] Plane<std::uint8_t> pixels_near(const std::vector<Piece>& pieces,
                                              const SceneAccelerator& accelerator, const View& view,
                                              const PixelRays& rays);

/// Whether any pixel may show one of these pieces.
[[nodiscard]] bool may_see(const std::vector<Piece>& pieces, const SceneAccelerator& accelerator,
                           const View& view, const PixelRays& rays);

/// Sets the pixels of `fine` that need more than one sample: those near actors, and those that differ from one of their
/// eight neighbours in object or material, seen or mirrored, or in depth by more than 2 %. `passes` have indices and depth.
void choose_pixels(const Passes& passes, const Plane<std::uint8_t>& near_actors, FineSamples& fine);

}  // namespace thermal
