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

/// Labels the actors of a clip's frames, all that can be told without the sensor.
class ActorLabeller {
 public:
  /// `map`: from the passes, where they are as fine as the camera, to its picture; null where they are that.
  /// `uses_depth`: whether passes come with depth for sure. Only then is it looked at, so that labels do not depend on
  /// what others have asked for.
  ActorLabeller(const Manifest& manifest, const LensDistortion& lens, std::shared_ptr<const ResampleMap> map,
                bool uses_depth = false);

  /// The actors that have a pixel of the camera's picture, by rising index. `uses` is a survey of the object index.
  ///
  /// In passes finer than the camera an actor has the pixels it covers at least half of; covered_px and visibility
  /// count the finer pixels, as often as the camera's pixels they are in show them. One that covers half of no pixel
  /// has no label.
  /// visibility: its pixels over its pixels in the actor layer, at most 1; not known where the frame has no such layer
  /// or that lacks the actor. Others may hide it there too.
  /// whole_box: about its pixels, in the actor layer too, extended() where it touches the border. An estimate: over the
  /// demo's actors, an end found so is off by 7 % of an elephant's side, 11 % of a zebra's, 13 % of a human's (rms); by
  /// the box in the world alone it would be too far out by 19 to 41 %. Not known, like truncated_fraction, where it
  /// touches a border and poses or bounds are not told.
  /// range_m: to the middle of the box in the world; else the mean over its pixels, where depth is used.
  /// DataError if the actor layer holds an index that is no actor's. Safe to call from several threads.
  [[nodiscard]] std::vector<Instance> label(const Passes& passes, std::span<const IndexUse> uses,
                                            const ManifestFrame& frame) const;

 private:
  struct Layer;
  [[nodiscard]] Layer look_at(const Plane<std::uint16_t>& fine, std::span<const IndexUse> uses) const;
  [[nodiscard]] Plane<std::uint16_t> in_picture(const Plane<std::uint16_t>& fine,
                                                std::span<const IndexUse> uses) const;
  [[nodiscard]] double shown_px(const Layer& layer, std::uint16_t index) const;
  void check_actors(std::span<const IndexUse> uses) const;
  void tell_visible(const Layer& all, const Layer* alone, Instance& instance) const;
  void tell_places(const ManifestFrame& frame, std::vector<Instance>& instances) const;
  [[nodiscard]] std::optional<double> mean_range_m(const Passes& passes, const IndexUse& use) const;

  CameraIntrinsics camera_;
  CameraIntrinsics passes_camera_;
  LensDistortion lens_;
  bool uses_depth_;
  int supersample_;
  std::shared_ptr<const ResampleMap> map_;
  Plane<std::uint16_t> times_shown_;    ///< of pixels as large as the camera's; where finer ones are counted
  std::vector<ManifestObject> actors_;  ///< by rising index
  IndexSet is_actor_;
};

}  // namespace thermal
