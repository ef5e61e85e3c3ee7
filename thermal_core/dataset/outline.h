#pragma once

#include <optional>
#include <vector>

#include "dataset/clip_maker.h"
#include "dataset/plan/plan.h"
#include "imaging/budget.h"
#include "io/config.h"

namespace thermal {

/// What the pictures of a planned dataset will show: its ground, plants and species, and the viewing directions of its
/// clips, one for each metre and degree. `config` has the plan's clips (with_flights_cut). Actors together count for 3 %. `materials` must outlive the result.
[[nodiscard]] SceneOutline outline_of(const Config& config, const DatasetPlan& plan,
                                      const MaterialLibrary& materials);

/// Information from the files of a clip besides its manifest.
struct PassesView {
  std::optional<PassNeeds> planes;        ///< of its first readable frame; empty: none is readable
  std::vector<SceneOutline::Look> looks;  ///< from that frame's depths, if the manifest has no height
};

/// Inspects the first readable frame of each clip.
[[nodiscard]] std::vector<PassesView> view_passes(const std::vector<ClipPasses>& sources);

/// The same for passes, whose scene no config describes: their manifests' materials, heights and angles. The physical
/// model also considers `views`: terms that need planes or poses missing from some passes are impossible. `materials`
/// must outlive the result.
[[nodiscard]] SceneOutline outline_of(const Config& config, const MaterialLibrary& materials,
                                      const std::vector<ClipPasses>& sources,
                                      const std::vector<PassesView>& views);

}  // namespace thermal
