#pragma once

#include <string>
#include <vector>

#include "bench/bench_scene.h"
#include "bench/sensor_scene.h"
#include "dataset/clip/maker.h"

namespace thermal {

/// Cost of a converter step per frame, and the limit set by the machine.
struct ConvertRow {
  std::string group;
  std::string name;
  double ms = 0;           ///< per frame
  double mb_per_s = 0;     ///< of input, 10^6 bytes
  std::string limit;       ///< lower bound measured in the same run; empty: none
  double times_limit = 0;  ///< its time / that of the limit
  std::string bound;       ///< bottleneck of a whole conversion
  std::vector<Figure> figures = {};
};

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
