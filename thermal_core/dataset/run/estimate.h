#pragma once

#include "io/config/config.h"

namespace thermal {

/// Estimated cost of a run.
struct Estimate {
  double seconds = 0;  ///< on two cores of a typical machine of 2020 or later
  double bytes = 0;    ///< of the finished dataset, without passes
};

/// Estimates a run over `frames` frames of a config's camera, in this many clips, by the config's engine. From
/// measurements of the savanna and the demo, for Blender by `veldt bench --suite render`: within a factor of two,
/// unless the place is far larger or emptier.
[[nodiscard]] Estimate estimate_run(const Config& config, int clips, int frames);

/// Of that, a clip of so many frames. How far clips of the same length differ, by the plants in view, is not known
/// before: by a quarter in flights at one height and angle of configs/airsim_w.json, by up to half in others.
[[nodiscard]] double clip_seconds(const Config& config, int frames);

}  // namespace thermal
