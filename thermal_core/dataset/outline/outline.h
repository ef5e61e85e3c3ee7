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
#include "dataset/plan/dataset_plan.h"
#include "imaging/budget.h"
#include "imaging/scene_radiance.h"
#include "io/config/spec.h"
#include "scene/manifest.h"

namespace thermal {

inline constexpr double kActorShare = 0.03;  ///< weight in the budget: a choice, not a property of the scene

/// An empty outline with a dataset's sensors; the least NETD of its clips is used.
[[nodiscard]] SceneOutline empty_outline(const DatasetSpec& spec);

/// Adds the materials of actors, which share kActorShare evenly.
void add_actors(const std::set<std::string>& names, const MaterialLibrary& materials, SceneOutline& outline);

/// Collects the viewing directions of cameras, by the weather and spectral response of clips.
class ViewingConditions {
 public:
  explicit ViewingConditions(const DatasetSpec& spec) : spec_(spec) {}

  /// A clip's camera above level ground, `look_angle_deg` below the horizon: means over the clip, rounded to whole
  /// metres, at least one, and degrees.
  void add(const ClipSpec& clip, double mean_height_m, double mean_look_angle_deg,
           const CameraIntrinsics& camera);

  /// Other known viewing directions.
  void add(const ClipSpec& clip, const std::vector<SceneOutline::ViewDirection>& view_directions);

  /// The collected conditions, winter first, with the temperatures of an outline's covers; computed on all threads.
  [[nodiscard]] std::vector<SceneOutline::Conditions> list(const SceneOutline& outline,
                                                           const MaterialLibrary& library) const;

 private:
  struct Conditions {
    Season season;
    Weather weather;
    SpectralResponse response;
    std::vector<SceneOutline::ViewDirection> view_directions = {};
    std::set<std::tuple<double, double, double, double>> seen = {};  ///< height, angle, focal length
  };
  Conditions& conditions_of(const ClipSpec& clip);

  const DatasetSpec& spec_;
  std::map<std::pair<Season, const ClipSettings*>, std::size_t> places_;
  std::vector<Conditions> nights_;
};

/// Outline of a planned dataset: its ground, plants and species, and the viewing directions of its clips, by metre and
/// degree. `spec` has the plan's clips (with_flights_cut). Actors together have a weight of 3 %. `materials` must
/// outlive the result.
[[nodiscard]] SceneOutline outline_of(const DatasetSpec& spec, const DatasetPlan& plan,
                                      const MaterialLibrary& materials);

/// Contents of a clip's files, besides its manifest.
struct PassesView {
  std::optional<PassNeeds> planes;  ///< of its first readable frame; empty: no frame is readable
  std::string fault = {};           ///< why no frame is readable; or empty
  std::vector<SceneOutline::ViewDirection>
      view_directions;           ///< from that frame's depths, if the manifest has no height
  bool has_ground_maps = false;  ///< beside the passes
};

/// Inspects the first readable frame of a clip; reads pixels only for `looks`.
[[nodiscard]] PassesView view_passes(const ClipPasses& source, bool view_directions);

/// The same of a clip whose first frame is in memory.
[[nodiscard]] PassesView view_planes(const Manifest& manifest, const Passes& first);

/// The same for passes without a config of their scene: from their manifests' materials, heights and angles. With the
/// physical model, terms that need planes or poses missing from some of `views` are impossible. A source is that of the
/// clip in its place. `materials` must outlive the result.
[[nodiscard]] SceneOutline outline_of(const DatasetSpec& spec, const MaterialLibrary& materials,
                                      const std::vector<ClipPasses>& sources,
                                      const std::vector<PassesView>& views);

/// The terms that each clip of a dataset keeps.
class KeptTerms {
 public:
  KeptTerms(const DatasetSpec& spec, const SceneOutline& outline);

  /// For clips without choices of their own.
  [[nodiscard]] const Budget& budget() const { return budgets_.front(); }
  [[nodiscard]] const Terms& of(const ClipSpec& clip) const;

 private:
  std::vector<TermChoices> choices_;  ///< the dataset's, then those of clips that differ
  std::vector<Budget> budgets_;       ///< of these
};

/// The task of making a clip with these terms, except for its folder. `ground`: see HeatSettings.
[[nodiscard]] ClipTask task_of(const DatasetSpec& spec, const ClipSpec& clip, const Terms& terms,
                               HeatDays& heat, std::shared_ptr<const GroundMaps> ground);

/// The entry of dataset.json on terms: the budget of a physical dataset, emission alone for the published model.
[[nodiscard]] Json to_json(const Budget& budget);

}  // namespace thermal
