#pragma once

#include <string>

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

/// Largest overscan on each side.
inline constexpr int kMostOverscanPx = 4096;

/// Lens distortion of a pinhole's picture, Brown-Conrady model: names, order and meaning are OpenCV's.
struct LensDistortion {
  double k1 = 0;  ///< radial, r^2; negative: barrel
  double k2 = 0;  ///< radial, r^4
  double p1 = 0;  ///< tangential
  double p2 = 0;  ///< tangential
  double k3 = 0;  ///< radial, r^6

  /// Whether there is no distortion.
  [[nodiscard]] bool is_none() const noexcept { return *this == LensDistortion(); }
  [[nodiscard]] bool operator==(const LensDistortion&) const = default;
};

/// A point of the picture in normalised coordinates: (u - cx) / fx to the right, (v - cy) / fy down.
struct LensPoint {
  double x = 0;
  double y = 0;
};

/// A position in the picture [px]; the top left pixel's centre is (0.5, 0.5), where OpenCV has (0, 0).
struct PicturePoint {
  double u_px = 0;
  double v_px = 0;
};

/// "k1 -0.2, k2 0.05, p1 0, p2 0, k3 0".
[[nodiscard]] std::string name_of(const LensDistortion& lens);

/// Position in the lens's picture of the point that a pinhole shows at `point`:
/// x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2), y' likewise with p1 and p2 exchanged. Source:
/// OpenCV 4.6, Camera Calibration and 3D Reconstruction, "Detailed Description".
[[nodiscard]] LensPoint distort(const LensDistortion& lens, const LensPoint& point) noexcept;

/// The inverse, by Newton's method from the point itself. Where distort() is one-to-one from the axis to there, as
/// overscan_px() checks, the error is at most 1e-12. NaN, NaN where the method does not converge.
/// Not cv::undistortPoints(): that iterates without the derivative, slowly, and its bits may differ between versions of
/// OpenCV.
[[nodiscard]] LensPoint undistort(const LensDistortion& lens, const LensPoint& point) noexcept;

/// Position in the picture of the direction (x, y, 1) in camera axes: cv::projectPoints(), whose results are 0.5 px
/// less.
[[nodiscard]] PicturePoint project(const CameraIntrinsics& camera, const LensDistortion& lens,
                                   const LensPoint& point) noexcept;

/// The inverse: direction of a position in the picture, with the error and the NaN of undistort().
[[nodiscard]] LensPoint unproject(const CameraIntrinsics& camera, const LensDistortion& lens,
                                  const PicturePoint& place) noexcept;

/// Pixels by which a pinhole's picture must exceed the camera's on every side, so that each of the camera's pixels can
/// be interpolated from four of its; 0 without distortion. ConfigError if the lens shows a point of the scene twice
/// within the picture, or needs more than kMostOverscanPx.
[[nodiscard]] int overscan_px(const CameraIntrinsics& camera, const LensDistortion& lens);

}  // namespace thermal
