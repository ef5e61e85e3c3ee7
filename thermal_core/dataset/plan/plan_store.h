#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dataset/dataset_file.h"
#include "dataset/plan/dataset_plan.h"
#include "dataset/plan/planner.h"
#include "heat/weather/sun.h"
#include "io/assets.h"
#include "io/config/config.h"
#include "io/system/files.h"
#include "scene/baked_scene.h"
#include "scene/ground_maps.h"
#include "scene/seen_ground.h"

namespace thermal {

/// What the folder of a plan is to a config.
struct PlanState {
  enum class Kind { missing, other_version, other_config, damaged, lacks_ground_maps, complete };
  Kind kind = Kind::missing;
  std::string why = {};   ///< it is not complete
  DatasetPlan plan = {};  ///< if it is complete or lacks nothing but maps of the ground
};

/// The days whose sun heats the ground of a config's clips and flights, each once.
[[nodiscard]] std::vector<SunPath> sun_paths(const DatasetSpec& spec);

/// The folder of a plan: plan.json, the baked scene and the tracks of clips, which the planner writes; maps of the ground
/// where the heat balance of the physical model needs them, for some plans the config, and SHA-256 of all other files,
/// which this class adds. Python reads it unchecked.
class PlanStore {
 public:
  PlanStore(Path folder, const Assets& assets) : folder_(std::move(folder)), assets_(assets) {}

  /// Whether there is a plan, of any state.
  [[nodiscard]] bool exists() const;

  /// Reads all files, the large ones last. `preview`: the plan is for pictures, which need no maps of the ground.
  [[nodiscard]] PlanState state(const ResolvedConfig& config, bool preview = false) const;

  /// plan_dataset() with all files. A complete plan is used again, and maps of the ground that it lacks are added. Any
  /// other is replaced in one step by a new one, after `may_replace` was called with the config cut to it; unless that
  /// throws. Of two runs at once, one plans, and the other waits for it.
  PlannedDataset plan(const ResolvedConfig& config, const std::string& name, const PlanOptions& options,
                      const std::function<void(const ResolvedConfig& cut)>& may_replace = {}) const;

  /// The same with the resolved config, for open().
  PlannedDataset plan_with_config(const ResolvedConfig& config, const std::string& name,
                                  const PlanOptions& options) const;

  /// Reads what plan_with_config() wrote. Plans nothing, and does not look at the files that the plan was made from:
  /// they need not exist on this machine. ConfigError with what is missing if the folder is no such plan; DataError if
  /// plan or config is damaged, of another plan, or of another version.
  [[nodiscard]] PlannedDataset open() const;

  /// DataError for the first damaged file of those that making these clips reads.
  void check_clips(const std::vector<std::string>& clips) const;

  /// Errors as read_baked_scene(); DataError too if its picture is not the config's.
  [[nodiscard]] BakedScene scene(const DatasetSpec& spec) const;

  /// Errors as read_baked_track(); DataError too if it has not the clip's frames, or another picture than the scene.
  [[nodiscard]] BakedTrack track(const ClipSpec& clip, const BakedScene& scene) const {
    return track(clip.id, clip.frames, scene);
  }
  [[nodiscard]] BakedTrack track(const std::string& clip, int frames, const BakedScene& scene) const;

  /// What the clips of the plan show, with all that a lens or overscan adds. Errors as track().
  [[nodiscard]] std::vector<GroundView> ground_views(const DatasetPlan& plan, const BakedScene& scene) const;

  /// Null if the config's temperatures need none. DataError if they lack days of the config; errors as read_ground_maps().
  [[nodiscard]] std::shared_ptr<const GroundMaps> ground_maps(const DatasetSpec& spec,
                                                              const BakedScene& scene) const;

  /// Copies the maps of the ground, if there are any, to a folder of passes, for their conversion.
  void copy_ground_maps(const Path& passes) const;

  /// Completes the folder: a plan that was damaged, or mixed with another, would make other frames without any sign of it.
  void write_checksums() const;

  [[nodiscard]] Path config_file() const { return folder_ / "config.json"; }

 private:
  [[nodiscard]] Path plan_file() const { return folder_ / "plan.json"; }
  [[nodiscard]] PlanStore unfinished() const;
  [[nodiscard]] bool is_undamaged() const;
  void check_is_made_from(const DatasetPlan& plan, const ResolvedConfig& config) const;
  void check_ground_days(const DatasetSpec& spec) const;
  [[nodiscard]] DatasetPlan made_again(
      const ResolvedConfig& config, const std::string& name, const PlanOptions& options,
      const std::function<void(const ResolvedConfig& cut)>& may_replace) const;
  void add_ground_maps(const Path& scratch, const DatasetSpec& spec, const DatasetPlan& plan,
                       const PlanOptions& options) const;

  Path folder_;
  Assets assets_;
};

/// ConfigError unless a run with this config may go on in a dataset's folder.
using CheckOut = void (*)(const Layout& out, const ResolvedConfig& cut);

/// Plans a dataset into OUT/plan; for a preview, into OUT/preview/plan. One of several runs that share the folder does
/// so; the others wait for it. `check` is asked before a plan is replaced: if it throws, nothing has changed.
PlannedDataset plan_in_dataset(const Path& out, const ResolvedConfig& config, const std::string& name,
                               const PlanOptions& options, CheckOut check = nullptr);

}  // namespace thermal
