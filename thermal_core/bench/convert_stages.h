#pragma once

#include <vector>

#include "bench/bench_scene.h"
#include "bench/convert_row.h"
#include "dataset/clip/maker.h"

namespace thermal {

/// A clip to measure: a scene, its frame in a file, and the output of one of the two models.
struct ConvertJob {
  const BenchScene& scene;
  Path file;  ///< of its passes
  const MaterialLibrary& materials;
  ClipTask published;
  ClipTask physical;
};

/// Every stage of a frame, one after another in one thread: first the machine's limits, then the stages of both
/// models. Writes into `folder`.
[[nodiscard]] std::vector<ConvertRow> convert_stage_rows(const ConvertJob& job, const Path& folder);

}  // namespace thermal
