#pragma once

#include <cstddef>
#include <memory>

#include "scene/baked_scene.h"
#include "scene/camera_model.h"
#include "scene/passes.h"

namespace thermal {

class PixelRays;
class SceneAccelerator;

/// The engine `embree`: a baked scene prepared for ray casting.
class RayCaster {
 public:
  /// Builds the structures that all frames share. The scene must outlive this object. Error if there is not enough
  /// memory.
  explicit RayCaster(const BakedScene& scene);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  [[nodiscard]] const SceneAccelerator& accelerator() const noexcept { return *accelerator_; }

 private:
  std::unique_ptr<const SceneAccelerator> accelerator_;
};

/// Ray positions of a picture.
struct Sampling {
  int supersample = 1;  ///< rays along each side of a pixel
  /// Only pixels that need them have all these rays, the others one through their centre: Passes::fine.
  bool adaptive = false;
  LensDistortion lens = {};  ///< distortion of the rays, so that the picture is exact
};

/// Renders the passes of one camera in a scene.
class CameraTracer {
 public:
  /// Pixels for which undistort() is NaN show sky. The caster must outlive this object.
  CameraTracer(const RayCaster& caster, const CameraIntrinsics& camera, const Sampling& sampling = {});
  ~CameraTracer();

  /// The needed planes of a moment, and both indices, as in Blender's passes: the first hit of each ray within the
  /// depths of BakedScene::depth_range_m; the sky has index 0, a depth of 1e10 m and a normal of 0. Depth and normals
  /// are exact to single precision, indices to about 1e-4 px at silhouettes, by Embree's single precision. Adaptive: a
  /// pixel has all rays if an actor may be in it, or if it differs from one of its eight neighbours in object or
  /// material, seen or mirrored, or in depth by more than 2 %. A plant between rays that no neighbour shows is missed.
  /// Materials of BakedScene::mirrors mirror as level surfaces.
  /// The result depends on nothing else. Memory of `out` is reused. Safe to call from several threads.
  void trace(const BakedMoment& now, const PassNeeds& needs, Passes& out) const;

 private:
  const SceneAccelerator& accelerator_;
  std::unique_ptr<const PixelRays> pixel_rays_;
  std::unique_ptr<const PixelRays> sample_rays_;  ///< adaptive
  int supersample_;
};

/// Renders the passes of a clip's frames.
class ClipTracer {
 public:
  /// Caster and track, which must belong to its scene, must outlive this object.
  ClipTracer(const RayCaster& caster, const BakedTrack& track, const CameraIntrinsics& camera,
             const Sampling& sampling = {});

  /// CameraTracer::trace() of a frame.
  void trace(std::size_t frame, const PassNeeds& needs, Passes& out) const {
    tracer_.trace(moments_.at_frame(frame), needs, out);
  }

 private:
  TrackMoments moments_;
  CameraTracer tracer_;
};

}  // namespace thermal
