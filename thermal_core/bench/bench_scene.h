#pragma once

#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// A synthetic frame and the meaning of its indices.
struct BenchScene {
  Manifest manifest;
  Passes passes;
};

/// Rolling ground of soil, grass, shrubs and water with people and elephants, seen at 45 deg from 61 m, with all planes
/// of a renderer, 640 x 512.
[[nodiscard]] BenchScene rolling_ground();

/// A person from above on bare soil, 122 m below, `factor` times finer than the camera, centred at a position in the
/// camera's pixels.
[[nodiscard]] BenchScene person_from_above(int factor, double x_px, double y_px);

/// The same scene with every pixel repeated `factor` times in both directions, as from a finer camera.
[[nodiscard]] BenchScene enlarged(const BenchScene& scene, int factor);

}  // namespace thermal
