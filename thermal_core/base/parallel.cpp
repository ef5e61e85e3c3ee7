#include "base/parallel.h"

#include <algorithm>
#include <cassert>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "base/happens_before.h"

namespace thermal {

int thread_count(int threads) { return threads > 0 ? threads : tbb::this_task_arena::max_concurrency(); }

void run_with_threads(int threads, const std::function<void()>& work) {
  tbb::task_arena arena(std::min(thread_count(threads), thread_count(0)));
  arena.execute(work);
}

void run_isolated(const std::function<void()>& work) { tbb::this_task_arena::isolate(work); }

void run_apart(const std::function<void()>& work) {
  tbb::task_arena arena(
      thread_count(0));  // its root task ends with the call, so no work stays attached to it
  arena.execute(work);
}

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body) {
  const std::size_t chunks = (count + grain - 1) / grain;
  DividedWork whole;
  // Otherwise a thread that waits for its chunks could pick up unrelated work that may block.
  run_isolated([&] {
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
      const DividedWork::Part part(whole);
      const std::size_t begin = chunk * grain;
      body(begin, std::min(begin + grain, count));
    });
  });
}

void parallel_rows(int rows, std::size_t grain, const std::function<void(int y)>& work) {
  parallel_for(static_cast<std::size_t>(rows), grain, [&](std::size_t begin, std::size_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) work(y);
  });
}

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
