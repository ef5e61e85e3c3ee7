#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "support/catch.h"
#include "support/patience.h"

namespace parallel_test {

using namespace thermal;

namespace {

/// The threads at work on chunks, each of which waits until so many have joined in, and gives others time to.
std::set<std::thread::id> threads_at_work(std::size_t awaited = 1) {
  std::set<std::thread::id> threads;
  std::mutex mutex;
  const auto have_joined = [&] {
    const std::lock_guard lock(mutex);
    return threads.size() >= awaited;
  };
  parallel_for(64, 1, [&](std::size_t, std::size_t) {
    std::this_thread::sleep_for(std::chrono::microseconds(500));
    {
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    }
    (void)wait_until(have_joined);
  });
  return threads;
}

}  // namespace

TEST_CASE("Chunks cover every index exactly once") {
  const auto count = GENERATE(as<std::size_t>{}, 0, 1, 7, 64, 1000);
  const auto grain = GENERATE(as<std::size_t>{}, 1, 7, 64, 5000);
  std::vector<std::atomic<int>> visits(count);
  parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++visits[i];
  });
  CHECK(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; }));
}

TEST_CASE("Rows are visited exactly once") {
  const int rows = GENERATE(0, 1, 7, 64);
  const auto grain = GENERATE(as<std::size_t>{}, 1, 5, 100);
  std::vector<std::atomic<int>> visits(static_cast<std::size_t>(rows));
  parallel_rows(rows, grain, [&](int y) { ++visits[static_cast<std::size_t>(y)]; });
  CHECK(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; }));
}

TEST_CASE("Chunks are the same whatever the number of threads") {
  const auto chunks = [] {
    std::set<std::pair<std::size_t, std::size_t>> found;
    std::mutex mutex;
    parallel_for(1001, 10, [&](std::size_t begin, std::size_t end) {
      const std::lock_guard lock(mutex);
      found.emplace(begin, end);
    });
    return found;
  };
  const auto alone = with_threads(1, chunks);
  CHECK(alone.size() == 101);
  CHECK(alone.contains({1000, 1001}));  // the last is shorter
  CHECK(with_threads(4, chunks) == alone);
}

TEST_CASE("A limit of one thread keeps all work on the caller's") {
  CHECK(with_threads(1, [] { return threads_at_work(); }) ==
        std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST_CASE("A limit bounds the threads at work, and ends with its work") {
  CHECK(with_threads(2, [] { return threads_at_work(); }).size() <= 2);
  if (thread_count(0) > 1) CHECK(threads_at_work(2).size() > 1);
}

TEST_CASE("No number of threads is as many as the limit around it, and a larger limit within has no effect") {
  const int unlimited = thread_count(0);
  CHECK(thread_count(3) == 3);
  for (const int limit : {1, 2}) {
    const int bound = std::min(limit, unlimited);
    CHECK(with_threads(limit, [] { return thread_count(0); }) == bound);
    CHECK(with_threads(limit, [] { return with_threads(0, [] { return thread_count(0); }); }) == bound);
    CHECK(with_threads(limit, [] { return with_threads(64, [] { return thread_count(0); }); }) == bound);
  }
  CHECK(with_threads(0, [] { return thread_count(0); }) == unlimited);
  CHECK(with_threads(1 << 20, [] { return thread_count(0); }) == unlimited);
  CHECK(thread_count(0) == unlimited);
}

TEST_CASE("An exception in a chunk reaches the caller") {
  const auto work = [](std::size_t begin, std::size_t) {
    if (begin == 50) throw std::runtime_error("chunk 50");
  };
  CHECK_THROWS_WITH(parallel_for(100, 1, work), "chunk 50");
}

}  // namespace parallel_test
