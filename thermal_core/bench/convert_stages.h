#pragma once

#include <vector>

#include "bench/bench_scene.h"
#include "bench/convert_row.h"
#include "dataset/clip_maker.h"

namespace thermal {

/// A clip to measure: a scene, its frame in a file, and what a dataset makes of it by one of the two models.
struct ConvertJob {
  const BenchScene& scene;
  Path file;  ///< of its passes
  const MaterialLibrary& materials;
  ClipTask published;
  ClipTask physical;
};

/// Every stage that a frame goes through, one after another in one thread: first what the machine allows, then the
/// stages of both models. Writes into `folder`.
[[nodiscard]] std::vector<ConvertRow> convert_stage_rows(const ConvertJob& job, const Path& folder);

}  // namespace thermal
