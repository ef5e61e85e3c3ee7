#pragma once

#include <array>
#include <vector>

#include "base/image.h"
#include "scene/manifest.h"

namespace thermal {

/// The camera whose pixels are `factor` times finer.
[[nodiscard]] CameraIntrinsics finer(const CameraIntrinsics& camera, int factor) noexcept;

/// The manifest's camera with overscan: one pixel for each of the passes' blocks of supersample x supersample.
[[nodiscard]] CameraIntrinsics pixels_camera(const Manifest& manifest) noexcept;

/// The camera of the passes: the manifest's, with overscan and supersampling.
[[nodiscard]] CameraIntrinsics passes_camera(const Manifest& manifest) noexcept;

/// Over how many evenly spread samples across a pixel the radiance is averaged. A cryptomatte states the share of a
/// pixel that each object covers, as if by very many samples.
[[nodiscard]] int samples_across_pixel(const Manifest& manifest) noexcept;

/// The rays of a camera, the same for all its frames.
class CameraRays {
 public:
  /// Rays are NaN where undistort() is.
  explicit CameraRays(const CameraIntrinsics& camera, const LensDistortion& lens = {});

  /// x and y of the rays through the pixels' centres, z being 1, in camera axes.
  [[nodiscard]] const Plane<float>& x() const noexcept { return x_; }
  [[nodiscard]] const Plane<float>& y() const noexcept { return y_; }
  /// Length of the ray with z = 1: range = depth * length.
  [[nodiscard]] const Plane<float>& length() const noexcept { return length_; }
  /// Side of a pixel at depth 1, on the axis; for pixels that are not square, the geometric mean of both.
  [[nodiscard]] float pixel_width() const noexcept { return pixel_width_; }

 private:
  Plane<float> x_;
  Plane<float> y_;
  Plane<float> length_;
  float pixel_width_;
};

/// Gain of each pixel's noise by the lens's cos^4 fall-off, after non-uniformity correction has evened out the signal:
/// its inverse, 1.37 at 22.5 deg off the axis.
[[nodiscard]] Plane<float> falloff_noise_gain(const CameraIntrinsics& camera);

/// Position and axes of the camera in one frame.
struct CameraPose {
  std::array<float, 3> position_m{};
  std::array<std::array<float, 3>, 3> rotation{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rows, world = R camera
};

/// The pose of a row-major 4 x 4 matrix.
[[nodiscard]] CameraPose pose_of(const std::array<double, 16>& camera_to_world) noexcept;

}  // namespace thermal
