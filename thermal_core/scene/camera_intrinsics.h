#pragma once

namespace thermal {

/// A pinhole camera in pixels. Continuous pixel coordinates: the top left pixel's centre is (0.5, 0.5).
struct CameraIntrinsics {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;

  [[nodiscard]] bool operator==(const CameraIntrinsics&) const = default;
};

}  // namespace thermal
