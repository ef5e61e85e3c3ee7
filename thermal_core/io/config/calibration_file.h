#pragma once

#include <string>
#include <string_view>

#include "io/system/files.h"
#include "scene/lens_distortion.h"

namespace thermal {

/// What a calibration found out about a camera and its lens.
struct Calibration {
  CameraIntrinsics camera;  ///< ours: the principal point is 0.5 px more than the file's, each way
  LensDistortion lens;
};

/// Reads the calibration of one camera:
/// - OpenCV's YAML, XML and JSON, as calibration.cpp, camera_calibration.cpp (2.4 and later), the ArUco samples and
///   opencv_interactive-calibration write it;
/// - ROS' camera_info YAML (image_width, camera_matrix: {rows, cols, data}, distortion_model), with its header or without.
/// Only the raw picture's camera is read: ROS' projection_matrix, of the rectified picture, does not count.
/// ConfigError "FILE: …" for what is malformed, larger than 1 MiB, or of a camera that is not modelled: skewed pixels;
/// rational, thin-prism and tilted lenses unless those coefficients are 0; fisheye lenses; one of a stereo pair, where
/// the file has a rotation to rectify it by, or both cameras (M1, D1). IoError if it cannot be read.
[[nodiscard]] Calibration read_calibration(const Path& file);

/// The same of a text; `name` begins faults.
[[nodiscard]] Calibration parse_calibration(std::string_view text, const std::string& name);

}  // namespace thermal
