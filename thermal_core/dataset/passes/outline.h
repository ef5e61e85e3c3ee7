#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "dataset/clip/heat_days.h"
#include "dataset/clip/maker.h"
#include "dataset/plan/plan.h"
#include "imaging/budget.h"
#include "imaging/scene_radiance.h"
#include "io/config/config.h"
#include "scene/manifest.h"

namespace thermal {

inline constexpr double kActorShare =
    0.03;  ///< of what the budget weighs: a choice, not a figure of the scene

/// An empty outline, seen by the config's cameras; the least NETD of its clips decides.
[[nodiscard]] SceneOutline empty_outline(const Config& config);

/// Adds the materials of actors, which share kActorShare evenly.
void add_actors(const std::set<std::string>& names, const MaterialLibrary& materials, SceneOutline& outline);

/// Collects the viewing directions of cameras, by the weather and the response of clips.
class Nights {
 public:
  explicit Nights(const Config& config) : config_(config) {}

  /// A clip's camera above level ground, `look_angle_deg` below the horizon: means over the clip, of which whole metres,
  /// at least one, and degrees count.
  void add(const ClipConfig& clip, double mean_height_m, double mean_look_angle_deg,
           const CameraIntrinsics& camera);

  /// Other known viewing directions.
  void add(const ClipConfig& clip, const std::vector<SceneOutline::Look>& looks);

  /// The nights, winter first, with the temperatures of an outline's covers; computed on all threads.
  [[nodiscard]] std::vector<SceneOutline::Night> list(const SceneOutline& outline,
                                                      const MaterialLibrary& library) const;

 private:
  struct Night {
    Season season;
    Weather weather;
    SpectralResponse response;
    std::vector<SceneOutline::Look> looks = {};
    std::set<std::tuple<double, double, double, double>> seen = {};  ///< height, angle, focal length
  };
  Night& night_of(const ClipConfig& clip);

  const Config& config_;
  std::map<std::pair<Season, const ClipSettings*>, std::size_t> places_;
  std::vector<Night> nights_;
};

/// What the pictures of a planned dataset will show: its ground, plants and species, and the viewing directions of its
/// clips, one for each metre and degree. `config` has the plan's clips (with_flights_cut). Actors together count for 3
/// %. `materials` must outlive the result.
[[nodiscard]] SceneOutline outline_of(const Config& config, const DatasetPlan& plan,
                                      const MaterialLibrary& materials);

/// Information from the files of a clip besides its manifest.
struct PassesView {
  std::optional<PassNeeds> planes;        ///< of its first readable frame; empty: none is readable
  std::string fault = {};                 ///< why none is readable; or empty
  std::vector<SceneOutline::Look> looks;  ///< from that frame's depths, if the manifest has no height
  bool has_ground_maps = false;           ///< beside the passes
};

/// Inspects the first readable frame of a clip; its pixels only for `looks`.
[[nodiscard]] PassesView view_passes(const ClipPasses& source, bool looks);

/// The same of a clip whose first frame is in memory.
[[nodiscard]] PassesView view_planes(const Manifest& manifest, const Passes& first);

/// The same for passes, whose scene no config describes: their manifests' materials, heights and angles. The physical
/// model also considers `views`: terms that need planes or poses missing from some passes are impossible. `materials`
/// must outlive the result.
[[nodiscard]] SceneOutline outline_of(const Config& config, const MaterialLibrary& materials,
                                      const std::vector<ClipPasses>& sources,
                                      const std::vector<PassesView>& views);

/// The terms that each clip of a dataset keeps.
class KeptTerms {
 public:
  KeptTerms(const Config& config, const SceneOutline& outline);

  /// Of the clips that have no choices of their own.
  [[nodiscard]] const Budget& budget() const { return budgets_.front(); }
  [[nodiscard]] const Terms& of(const ClipSettings& settings) const;

 private:
  std::vector<TermChoices> choices_;  ///< the dataset's, then those of clips that differ
  std::vector<Budget> budgets_;       ///< of these
};

/// What a dataset makes of a clip that keeps these terms, but for the folder to make it in. `ground`: see HeatSettings.
[[nodiscard]] ClipTask task_of(const Config& config, const ClipConfig& clip, const Terms& terms,
                               HeatDays& heat, std::shared_ptr<const GroundMaps> ground);

/// The entry of dataset.json on terms: the budget of a physical dataset, emission alone for the published model.
[[nodiscard]] Json to_json(const Budget& budget);

}  // namespace thermal
