#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace thermal {

/// `threads`, or one per core if it is 0.
[[nodiscard]] int thread_count(int threads);

/// Limits the number of threads the library uses while it lives. 0: one per core.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Calls body(begin, end) on chunks that cover [0, count) exactly once, in any order and on any thread. Chunks depend
/// only on `count` and `grain`, so work that is a function of its chunk is deterministic.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace thermal
