#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace thermal {

/// What a pipeline does with each item.
struct PipelineStage {
  bool in_order;  ///< one item after another, by number; otherwise several at the same time, in any order
  std::function<void(std::size_t item)> work;
};

/// Passes the items 0, 1, 2, … through the stages, on the library's threads (run_with_threads()). Calls `enter` with
/// the number of each item in turn, until it returns false: that item and those after it do not exist. `in_flight`
/// items at most are past `enter` and not yet through the last stage. That stage must be in order, so item k is
/// through when item k + in_flight enters. If something throws, all stages end and the first exception is rethrown.
void run_pipeline(std::size_t in_flight, const std::function<bool(std::size_t item)>& enter,
                  const std::vector<PipelineStage>& stages);

}  // namespace thermal
