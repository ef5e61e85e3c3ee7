#pragma once

#include "io/json/file.h"
#include "scene/camera_model.h"

namespace thermal {

// Cameras in JSON: configs, manifests, plans and baked scenes.

/// From width_px, height_px, fx_px, fy_px, cx_px and cy_px.
[[nodiscard]] CameraIntrinsics intrinsics_of(const Json& json);
/// The inverse of intrinsics_of().
[[nodiscard]] Json to_json(const CameraIntrinsics& camera);

/// From k1, k2, p1, p2 and k3.
[[nodiscard]] LensDistortion distortion_of(const Json& json);
/// The inverse of distortion_of().
[[nodiscard]] Json to_json(const LensDistortion& lens);

}  // namespace thermal
