#include "base/parallel.h"

#include <algorithm>

#include <oneapi/tbb/parallel_for.h>
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

}  // namespace thermal
