#pragma once

#include <memory>

#include "dataset/clip/task.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/options.h"
#include "raycast/ray_caster.h"
#include "scene/baked_scene.h"

namespace thermal {

/// A frame of a manifest, rounded to the micrometre or finer: far less than a pixel, and more than the cosines of two
/// machines differ by. Without a file, and without the camera's height and angle.
[[nodiscard]] ManifestFrame manifest_frame_of(const BakedScene& scene, const BakedMoment& now, double time_s);

/// The manifest of a clip of a plan, whose passes the config's engine renders. `settings`: the clip's.
[[nodiscard]] Manifest manifest_of(const BakedScene& scene, const BakedTrack& track, const ClipPlan& clip,
                                   const Config& config, const ClipSettings& settings);

/// The engine `embree` on one plan: renders passes of its clips in memory.
class PlanTracer {
 public:
  /// Reads the baked scene in `folder` and builds its structures. DataError or IoError as read_baked_scene(), also if
  /// its picture is not the config's. Config and plan must outlive this object.
  PlanTracer(const Path& folder, const Config& config, const DatasetPlan& plan, const Assets& assets);

  /// A clip's passes. Each frame is rendered when it is read. `keep` writes the frames read, and the manifest, to
  /// `folder` as well, as Blender does; frames whose files exist are rendered, but not written again.
  /// This object must outlive them. DataError or IoError as read_baked_track(), also if the
  /// track has not the plan's frames.
  [[nodiscard]] ClipPasses trace(const std::string& clip, const Path& folder, bool keep) const;

 private:
  Path folder_;
  const Config& config_;
  const DatasetPlan& plan_;
  Assets assets_;
  BakedScene scene_;
  RayCaster caster_;
};

}  // namespace thermal
