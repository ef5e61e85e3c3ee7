#pragma once

#include <array>
#include <optional>

#include "labels/label_set.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"

namespace thermal {

/// An actor's box in the world, projected into the camera.
struct SeenBox {
  double range_m = 0;  ///< from the camera to the box's centre
  std::optional<LabelBox>
      box_px;  ///< bounding box of its projected corners, also outside the picture; empty if all are behind the camera
};

/// Projects an actor's box, by the manifest's bounds and poses; empty without bounds. Parts nearer than kNearestM or
/// behind the camera are clipped, so that coordinates are finite. Beyond the picture, distorted corners are limited to
/// where Brown and Conrady's polynomials stop being monotonic, and to three times the distance of the picture's
/// farthest corner from the axis. Because the lens bends straight lines, the box of the corners may miss parts between
/// them.
[[nodiscard]] std::optional<SeenBox> see_box(const CameraIntrinsics& camera, const LensDistortion& lens,
                                             const ManifestObject& actor, const ActorPose& pose,
                                             const std::array<double, 16>& camera_to_world);

/// Points nearer to the camera are not projected.
inline constexpr double kNearestM = 0.05;

/// The visible box of an actor within the picture, extended beyond each border it touches to the projected box of the
/// actor, minus the projected box's margin on the opposite side, if that side is in the picture: a projected box is
/// wider than the body by about the same amount on both sides.
[[nodiscard]] LabelBox extended(const LabelBox& seen, const LabelBox& box, const CameraIntrinsics& camera);

}  // namespace thermal
