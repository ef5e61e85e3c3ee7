#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/render_suite.h"
#include "io/assets.h"

namespace thermal {

struct EnginesSuiteTask {
  Path blender;  ///< empty: `embree` alone is measured
  Assets assets;
  int threads = 0;                                        ///< of each engine; 0: thread_count(0)
  std::function<void(const std::string&)> announce = {};  ///< the next measurement
};

/// Both engines on the same frames of passes: time by view and rays per pixel, pixels that differ, memory; rays/s of the
/// ray caster beside those of Embree alone; memory by plants, frames and threads. Takes minutes. IoError if Blender
/// fails.
[[nodiscard]] std::vector<RenderRow> run_engines_suite(const EnginesSuiteTask& task);

}  // namespace thermal
