#include "base/pipeline.h"

#include <cassert>
#include <optional>

#include <oneapi/tbb/parallel_pipeline.h>

#include "base/happens_before.h"

namespace thermal {
namespace {

using tbb::filter_mode;

/// The stages as TBB's filters. They pass on numbers, because TBB leaks the memory it allocates to pass larger objects
/// when a stage throws.
class Pipeline {
 public:
  Pipeline(std::size_t in_flight, const std::function<bool(std::size_t)>& enter,
           const std::vector<PipelineStage>& stages)
      : enter_(enter), stages_(stages), in_order_(stages.size()), slots_(in_flight) {
    assert(in_flight > 0 && !stages.empty() && stages.back().in_order);
  }

  void run() {
    tbb::filter<void, std::size_t> filters = tbb::make_filter<void, std::size_t>(
        filter_mode::serial_in_order, [this](tbb::flow_control& control) { return next(control); });
    const std::size_t last = stages_.size() - 1;
    for (std::size_t stage = 0; stage < last; ++stage)
      filters &= tbb::make_filter<std::size_t, std::size_t>(
          mode(stage), [this, stage](std::size_t item) { return work(stage, item); });
    const auto leave = tbb::make_filter<std::size_t, void>(
        mode(last), [this, last](std::size_t item) { (void)work(last, item); });
    tbb::parallel_pipeline(slots_.size(), filters & leave);
  }

 private:
  [[nodiscard]] filter_mode mode(std::size_t stage) const {
    return stages_[stage].in_order ? filter_mode::serial_in_order : filter_mode::parallel;
  }

  /// Orders the stages of an item, and its last stage before the entry of the item that reuses the slot.
  HappensBefore& slot(std::size_t item) { return slots_[item % slots_.size()]; }

  std::size_t next(tbb::flow_control& control) {
    const DividedWork::Part part(whole_);
    const Turn entrance(entrance_);
    const Turn turn(slot(next_item_));
    if (enter_(next_item_)) return next_item_++;
    control.stop();
    return 0;
  }

  std::size_t work(std::size_t stage, std::size_t item) {
    const DividedWork::Part part(whole_);
    const Turn turn(slot(item));
    std::optional<Turn> after_item_before;
    if (stages_[stage].in_order) after_item_before.emplace(in_order_[stage]);
    stages_[stage].work(item);
    return item;
  }

  const std::function<bool(std::size_t)>& enter_;
  const std::vector<PipelineStage>& stages_;
  DividedWork whole_;
  HappensBefore entrance_;
  std::vector<HappensBefore> in_order_;  ///< of each stage
  std::vector<HappensBefore> slots_;
  std::size_t next_item_ = 0;
};

}  // namespace

void run_pipeline(std::size_t in_flight, const std::function<bool(std::size_t)>& enter,
                  const std::vector<PipelineStage>& stages) {
  Pipeline(in_flight, enter, stages).run();
}

}  // namespace thermal
