#pragma once

#include <memory>

#include "dataset/clip/task.h"
#include "dataset/plan/plan_store.h"
#include "io/config/spec.h"
#include "raycast/ray_caster.h"
#include "scene/baked_scene.h"

namespace thermal {

/// A frame of a manifest, rounded to the micrometre or finer: far less than a pixel, and more than the cosines of two
/// machines differ by. Without a file, and without the camera's height and angle.
[[nodiscard]] ManifestFrame manifest_frame_of(const BakedScene& scene, const BakedMoment& now, double time_s);

/// The manifest of a planned clip, whose passes the dataset's engine renders.
[[nodiscard]] Manifest manifest_of(const BakedScene& scene, const BakedTrack& track, const DatasetSpec& spec,
                                   const ClipSpec& clip);

/// The engine `embree` on one plan: renders passes of its clips in memory.
class PlanTracer {
 public:
  /// Reads the baked scene and builds its structures. Errors as PlanStore::scene(). `spec`, with the plan's clips, must
  /// outlive this object.
  PlanTracer(PlanStore store, const DatasetSpec& spec);

  [[nodiscard]] const BakedScene& scene() const noexcept { return scene_; }

  /// A clip's passes. Each frame is rendered when it is read. `keep` writes the frames read, and the manifest, to
  /// `folder` as well, as Blender does; frames whose files exist are rendered, but not written again.
  /// This object must outlive them. Errors as PlanStore::track().
  [[nodiscard]] ClipPasses trace(const ClipSpec& clip, const Path& folder, bool keep) const;

 private:
  PlanStore store_;
  const DatasetSpec& spec_;
  BakedScene scene_;
  RayCaster caster_;
};

}  // namespace thermal
