#pragma once

#include <array>
#include <vector>

#include "raycast/place.h"
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

  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }
  [[nodiscard]] LensPoint at(std::size_t x_px, std::size_t y_px) const noexcept {
    return bent_.empty() ? LensPoint{.x = x_[x_px], .y = y_[y_px]} : bent_[y_px * x_.size() + x_px];
  }

 private:
  int width_px_;
  int height_px_;
  std::vector<double> x_;        ///< a pinhole's, by column
  std::vector<double> y_;        ///< by row
  std::vector<LensPoint> bent_;  ///< a lens's, row by row; empty: a pinhole
};

/// Fills the planes of `out` that are needed with what the rays of one view see.
void trace_frame(const Place& place, const PieceSet& actors, const View& view, const PixelRays& rays,
                 const PassNeeds& needs, Passes& out);

}  // namespace thermal
