#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/render_suite.h"
#include "io/assets.h"

namespace thermal {

struct MapsSuiteTask {
  Assets assets;
  int threads = 0;                                        ///< 0: thread_count(0)
  std::function<void(const std::string&)> announce = {};  ///< the next measurement
};

/// Maps of the ground of the demo, of the savanna, and of the savanna towards its horizon: processor time, the share of
/// the cells that are traced, and the error of the sky view that pixels of ground read, against 2584 rays a cell with
/// nothing left out. Takes minutes.
[[nodiscard]] std::vector<RenderRow> run_maps_suite(const MapsSuiteTask& task);

}  // namespace thermal
