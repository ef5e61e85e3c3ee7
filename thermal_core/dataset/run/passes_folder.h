#pragma once

#include <string>
#include <vector>

#include "dataset/dataset_file.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/monitor.h"
#include "dataset/run/options.h"
#include "dataset/run/render_job.h"
#include "io/config/config.h"
#include "scene/baked_scene.h"
#include "scene/manifest.h"

namespace thermal {

/// Prepares the folders for the passes of a run's clips: one each, without unusable passes of earlier runs, and the
/// resolved config beside them. A clip's folder shows other runs that the clip is being made.
void begin_passes(const Layout& layout, const ResolvedConfig& config, const std::vector<std::string>& clips);

/// A folder for passes belongs to one config, like a dataset's. ConfigError with the keys that differ.
void check_same_passes(const Layout& layout, const ResolvedConfig& config);

/// Removes the passes of these clips, and with the last clip's everything beside them. Passes that veldt render made of
/// another config stay. Returns what could not be removed.
std::vector<LeftOver> end_passes(const Layout& layout, const ResolvedConfig& config,
                                 const std::vector<std::string>& clips);

/// The manifests of planned clips that Blender renders.
class PlannedManifests {
 public:
  /// Reads the scene. `spec` must outlive this object. Errors as PlanStore::scene().
  PlannedManifests(const DatasetSpec& spec, const GenerateOptions& options);

  [[nodiscard]] const BakedScene& scene() const noexcept { return scene_; }

  /// Errors as PlanStore::track().
  [[nodiscard]] Manifest of(const ClipSpec& clip) const;

  /// Puts those of some clips beside their passes, unless they are there; before Blender begins, which may be fast.
  /// ConfigError if there are frames of another.
  void write(const std::vector<ClipSpec>& clips) const;

 private:
  const DatasetSpec& spec_;
  Layout layout_;
  PlanStore store_;
  BakedScene scene_;
};

/// The render jobs for these clips, one task each. They report restarts to the monitor.
[[nodiscard]] std::vector<RenderJob::Task> passes_tasks(const DatasetSpec& spec,
                                                        const GenerateOptions& options,
                                                        const std::vector<std::string>& clips,
                                                        RunMonitor& monitor);

}  // namespace thermal
