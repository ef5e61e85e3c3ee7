#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <type_traits>
#include <vector>

namespace thermal {

/// How many threads the library's loops use on this thread: `threads`, or if it is 0, the limit of run_with_threads(),
/// without one a thread per core that this process may run on (CPU affinity).
[[nodiscard]] int thread_count(int threads);

/// Calls `work` on this thread. The library's loops in it use at most `threads` threads, this one included, and at most
/// thread_count(0), which 0 stands for. Threads that `work` starts itself, and the rest of the program, are not
/// limited.
void run_with_threads(int threads, const std::function<void()>& work);

/// The same for work with a result.
template <typename Work>
auto with_threads(int threads, const Work& work) {
  using Result = std::invoke_result_t<const Work&>;
  if constexpr (std::is_void_v<Result>) {
    run_with_threads(threads, work);
  } else {
    std::optional<Result> result;
    run_with_threads(threads, [&] { result.emplace(work()); });
    return *std::move(result);
  }
}

/// Calls `work` on this thread. While it waits for other threads, it takes on no unrelated work.
void run_isolated(const std::function<void()>& work);

/// The same for a library whose objects keep TBB tasks: none stays attached to the loops around this call. Takes some
/// microseconds more.
void run_apart(const std::function<void()>& work);

/// Calls body(begin, end) on chunks that cover [0, count) exactly once, in any order and on any thread. Chunks depend
/// only on `count` and `grain`, so work that is a function of its chunk is deterministic.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls work(y) once for each of `rows` rows, likewise; `grain` rows are a chunk.
void parallel_rows(int rows, std::size_t grain, const std::function<void(int y)>& work);

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
