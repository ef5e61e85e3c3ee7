#pragma once

#include <string>
#include <string_view>

#include "io/system/files.h"
#include "scene/camera_model.h"

namespace thermal {

/// What a calibration found out about a camera and its lens.
struct Calibration {
  CameraIntrinsics camera;  ///< ours: the principal point is 0.5 px more than the file's, each way
  LensDistortion lens;
};

/// Reads the calibration of one camera:
/// - OpenCV's YAML, XML and JSON, as calibration.cpp, camera_calibration.cpp (2.4 and later), the ArUco samples and
///   opencv_interactive-calibration write it: image_width and image_height or cameraResolution, camera_matrix,
///   distortion_coefficients or dist_coeffs;
/// - ROS' camera_info YAML (image_width, camera_matrix: {rows, cols, data}, distortion_model), with its header or without,
///   and one camera_info message as `ros2 topic echo` and `rostopic echo` print it (width, height, k, d, r; or K, D, R);
/// - Kalibr's camchain of one camera (cam0: camera_model, distortion_model, intrinsics, distortion_coeffs, resolution).
/// Only the raw picture's camera is read: names, headers, times, errors, ROS' projection matrix (of the rectified picture)
/// and Kalibr's places of cameras are ignored. What would change the camera is refused by name: camera_model, camera_type,
/// lens_model and model_type other than pinhole, other distortion models, fisheye lenses, xi, binning, a region of
/// interest, and a rotation to rectify one of a stereo pair by.
/// ConfigError "FILE: …" for that, for what is malformed (`calibration_tree`), and for skewed pixels; rational, thin-prism
/// and tilted lenses unless those coefficients are 0; and two cameras (M1, D1; cam0, cam1). IoError if it cannot be read.
[[nodiscard]] Calibration read_calibration(const Path& file);

/// The same of a text; `name` begins faults.
[[nodiscard]] Calibration parse_calibration(std::string_view text, const std::string& name);

}  // namespace thermal
