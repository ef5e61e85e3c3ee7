#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "imaging/sampling.h"
#include "labels/instances.h"
#include "labels/label_set.h"
#include "scene/camera_model.h"
#include "scene/manifest.h"
#include "scene/passes.h"

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

/// Labels the actors of a clip's frames with everything that does not need the sensor.
class ActorLabeller {
 public:
  /// `map`: from passes at the camera's resolution to its picture; null where they are the same.
  ActorLabeller(const Manifest& manifest, const LensDistortion& lens, std::shared_ptr<const ResampleMap> map);

  /// Whether label() needs depth for some range: of an actor without a pose or bounds, or in a frame without a pose of
  /// the camera. Passes must then have their depth, if there is any.
  [[nodiscard]] bool wants_depth() const noexcept { return wants_depth_; }

  /// The actors with at least one pixel in the camera's picture, in ascending order of index. `uses` is a survey of
  /// the object index.
  ///
  /// In passes finer than the camera, an actor has the pixels of which it covers at least half; covered_px and
  /// visibility count finer pixels, weighted by how often the camera shows them. An actor that covers half of no
  /// pixel has no label.
  /// visibility: its pixels / its pixels in the actor layer, at most 1; empty if the frame has no such layer or the
  /// layer lacks the actor. Other actors may hide it there too.
  /// whole_box: the box of its pixels, including the actor layer, extended() where it touches the border. An
  /// estimate: over the demo's actors, an end found so is off by 7 % of an elephant's side, 11 % of a zebra's, 13 %
  /// of a human's (rms); the box in the world alone would be too large by 19 to 41 %. Empty, like truncated_fraction,
  /// if it touches a border and poses or bounds are not given.
  /// range_m: to the centre of the box in the world; otherwise the mean over its pixels with a depth in kDistanceM, if passes
  /// have depth.
  /// DataError if the actor layer holds an index that is not an actor's. Safe to call from several threads.
  [[nodiscard]] std::vector<Instance> label(const Passes& passes, std::span<const IndexUse> uses,
                                            const ManifestFrame& frame) const;

 private:
  struct Layer;
  [[nodiscard]] Layer layer_of(const Plane<std::uint16_t>& fine, std::span<const IndexUse> uses) const;
  [[nodiscard]] Plane<std::uint16_t> in_picture(const Plane<std::uint16_t>& fine,
                                                std::span<const IndexUse> uses) const;
  [[nodiscard]] double shown_px(const Layer& layer, std::uint16_t index) const;
  void check_actors(std::span<const IndexUse> uses) const;
  void set_visible(const Layer& all, const Layer* alone, Instance& instance) const;
  void set_places(const ManifestFrame& frame, std::vector<Instance>& instances) const;
  [[nodiscard]] std::optional<double> mean_range_m(const Passes& passes, const IndexUse& use) const;

  CameraIntrinsics camera_;
  CameraIntrinsics passes_camera_;
  LensDistortion lens_;         ///< of the picture
  LensDistortion passes_lens_;  ///< of the passes
  bool wants_depth_;
  int supersample_;
  std::shared_ptr<const ResampleMap> map_;
  Plane<std::uint16_t> times_shown_;    ///< in pixels of the camera's size; where finer ones are counted
  std::vector<ManifestObject> actors_;  ///< in ascending order
  IndexSet is_actor_;
};

}  // namespace thermal
