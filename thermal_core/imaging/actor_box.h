#pragma once

#include <array>
#include <optional>

#include "labels/label_set.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"

namespace thermal {

/// What an actor's box in the world is to the camera.
struct SeenBox {
  double range_m = 0;  ///< from the camera to the box's middle
  std::optional<LabelBox>
      box_px;  ///< about the box's corners in the picture, wherever; empty if all is behind the camera
};

/// Where an actor's box lies, by the manifest's bounds and poses; nothing if the bounds are not told.
/// What lies less than kNearestM before the camera, or behind it, is cut off, so that places are finite. A lens that
/// distorts shows corners beyond the picture as far out as it shows anything in their direction: where Brown and
/// Conrady's polynomials fold over, and at three times the distance of the picture's farthest corner from the axis,
/// it ends. As it bends straight lines, the box about the corners may lack some of what lies between them.
[[nodiscard]] std::optional<SeenBox> see_box(const CameraIntrinsics& camera, const LensDistortion& lens,
                                             const ManifestObject& actor, const ActorPose& pose,
                                             const std::array<double, 16>& camera_to_world);

inline constexpr double kNearestM = 0.05;

/// What is seen of an actor, within the picture, and beyond each border it touches what its box in the world says: as
/// far as that reaches there, less what it is wider than the actor at the opposite side, where that is in the
/// picture. For the box is wider than a body, and about as much at either side.
[[nodiscard]] LabelBox extended(const LabelBox& seen, const LabelBox& box, const CameraIntrinsics& camera);

}  // namespace thermal
