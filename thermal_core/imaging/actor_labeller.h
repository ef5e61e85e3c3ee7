#pragma once

#include <memory>
#include <span>
#include <vector>

#include "imaging/resample.h"
#include "labels/instances.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

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
