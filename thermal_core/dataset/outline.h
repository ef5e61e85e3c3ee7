#pragma once

#include <optional>
#include <vector>

#include "dataset/clip_maker.h"
#include "imaging/budget.h"
#include "io/config.h"

namespace thermal {

/// What a config's pictures will hold: its ground, plants and species, and where its clips look from.
/// Shares of the pictures are estimates from densities and sizes; actors together count for 3 %.
[[nodiscard]] SceneOutline outline_of(const Config& config, const MaterialLibrary& materials,
                                      const Path& home);

/// What the files of a clip tell beside its manifest.
struct PassesView {
  std::optional<PassNeeds> planes;  ///< that its first readable frame has; empty: there is no such frame
  std::vector<SceneOutline::Look> looks;  ///< by that frame's depths, where the manifest tells no height
};

/// Looks into the first frame of each clip that can be read.
[[nodiscard]] std::vector<PassesView> view_passes(const std::vector<ClipPasses>& sources);

/// The same of passes, whose scene no config describes: their manifests' materials, heights and angles. The physical model
/// has `views` of them, too: terms that draw on planes or poses which some passes lack are impossible. `materials` must
/// outlive it.
[[nodiscard]] SceneOutline outline_of(const Config& config, const MaterialLibrary& materials,
                                      const std::vector<ClipPasses>& sources,
                                      const std::vector<PassesView>& views);

}  // namespace thermal
