#pragma once

#include <array>
#include <vector>

#include "raycast/place.h"
#include "raycast/vectors.h"
#include "scene/lens_distortion.h"
#include "scene/passes.h"

namespace thermal {

/// Where the camera is in a frame, and its axes: columns of the pose. In single precision, as Blender keeps them.
struct View {
  Vector3 right;
  Vector3 down;
  Vector3 forward;
  Vector3 position_m;
};

[[nodiscard]] View view_of(const std::array<double, 16>& camera_to_world) noexcept;

/// The rays of a camera: through pixel (x, y), in camera axes, z being 1.
class PixelRays {
 public:
  PixelRays(const CameraIntrinsics& camera, const std::vector<LensPoint>& bent)
      : camera_(camera), bent_(bent) {}

  [[nodiscard]] int width_px() const noexcept { return camera_.width_px; }
  [[nodiscard]] int height_px() const noexcept { return camera_.height_px; }
  [[nodiscard]] LensPoint at(int x, int y) const noexcept {
    if (bent_.empty())
      return {.x = (x + 0.5 - camera_.cx_px) / camera_.fx_px, .y = (y + 0.5 - camera_.cy_px) / camera_.fy_px};
    return bent_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px) +
                 static_cast<std::size_t>(x)];
  }

 private:
  const CameraIntrinsics& camera_;
  const std::vector<LensPoint>& bent_;
};

/// Fills the planes of `out` that are needed with what the rays of one view see.
void trace_frame(const Place& place, const PieceSet& actors, const View& view, const PixelRays& rays,
                 const PassNeeds& needs, Passes& out);

}  // namespace thermal
