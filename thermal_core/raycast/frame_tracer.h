#pragma once

#include <array>
#include <vector>

#include "raycast/shot.h"
#include "raycast/vectors.h"
#include "scene/lens_distortion.h"
#include "scene/passes.h"

namespace thermal {

/// The view of a pose, in single precision, as Blender keeps it.
[[nodiscard]] View view_of(const std::array<double, 16>& camera_to_world) noexcept;

/// Where the rays of a camera go: through pixel (x, y), in camera axes, z being 1.
class PixelRays {
 public:
  PixelRays(const CameraIntrinsics& camera, const LensDistortion& lens);

  [[nodiscard]] const CameraIntrinsics& camera() const noexcept { return camera_; }
  [[nodiscard]] int width_px() const noexcept { return camera_.width_px; }
  [[nodiscard]] int height_px() const noexcept { return camera_.height_px; }
  [[nodiscard]] bool is_pinhole() const noexcept { return bent_.empty(); }
  [[nodiscard]] LensPoint at(std::size_t x_px, std::size_t y_px) const noexcept {
    return bent_.empty() ? LensPoint{.x = x_[x_px], .y = y_[y_px]} : bent_[y_px * x_.size() + x_px];
  }

 private:
  CameraIntrinsics camera_;
  std::vector<double> x_;        ///< a pinhole's, by column
  std::vector<double> y_;        ///< by row
  std::vector<LensPoint> bent_;  ///< a lens's, row by row; empty: a pinhole
};

/// Fills the planes of `out` that are needed, and both indices. `near_actors`: pixels whose ray may hit an actor.
void trace_pixels(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                  const PassNeeds& needs, Passes& out);

/// Fills the lists of `fine` that are needed, and both indices; the pixels are given. `rays` are those of samples,
/// `near_actors` of pixels.
void trace_samples(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                   const PassNeeds& needs, FineSamples& fine);

}  // namespace thermal
