// Races on purpose. ThreadSanitizer must report each of them: what base/happens_before.h says to it must not hide any.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "base/parallel.h"

namespace {

using namespace thermal;

/// Has one thread wait for another, without any order that C++ knows of: all accesses are relaxed.
class Signal {
 public:
  void give() { given_.store(true, std::memory_order_relaxed); }
  void wait() const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
    while (!given_.load(std::memory_order_relaxed)) {
      if (std::chrono::steady_clock::now() > end) give_up();
      std::this_thread::yield();
    }
  }

 private:
  [[noreturn]] static void give_up() {
    std::puts("no other thread came");
    std::_Exit(1);
  }

  std::atomic<bool> given_ = false;
};

/// Two threads change `shared`. The second one begins when the first has ended what it was in, and has gone on to
/// something else, where it waits. So the race is with what is over, and an order that is invented there hides it.
struct Race {
  Signal first_over;
  Signal second_over;
  alignas(64) int shared = 0;  ///< away from those: of 8 bytes, ThreadSanitizer remembers 4 accesses only

  void first() { ++shared; }
  void after_first() {
    first_over.give();
    second_over.wait();
  }
  void before_second() const { first_over.wait(); }
  void second() {
    ++shared;
    second_over.give();
  }
};

using Steps = std::map<std::size_t, std::function<void()>>;  ///< at an item or at a chunk of a thread

std::function<void(std::size_t)> taking(const Steps& steps) {
  return [steps](std::size_t number) {
    if (const auto step = steps.find(number); step != steps.end()) step->second();
  };
}

void race_of_chunks(Race& race) {
  const auto here = taking({{1, [&] { race.first(); }}, {2, [&] { race.after_first(); }}});
  const auto there = taking({{1, [&] { race.before_second(); }}, {2, [&] { race.second(); }}});
  parallel_for(1000, 1, [&, caller = std::this_thread::get_id()](std::size_t, std::size_t) {
    thread_local std::size_t chunk = 0;
    (std::this_thread::get_id() == caller ? here : there)(++chunk);
  });
}

bool enter_two(std::size_t item) { return item < 2; }

/// Of two items in a stage that is not in order.
void race_of_items(Race& race) {
  run_pipeline(
      2, enter_two,
      {{.in_order = false, .work = taking({{1, [&] { race.before_second(); }}})},
       {.in_order = false, .work = taking({{0, [&] { race.first(); }}, {1, [&] { race.second(); }}})},
       {.in_order = true, .work = taking({{0, [&] { race.after_first(); }}})}});
}

/// Of an item in a stage that is in order, and another in one that is not.
void race_of_stages(Race& race) {
  run_pipeline(2, enter_two,
               {{.in_order = false, .work = taking({{1, [&] { race.before_second(); }}})},
                {.in_order = false, .work = taking({{1, [&] { race.second(); }}})},
                {.in_order = true, .work = taking({{0, [&] { race.first(); }}})},
                {.in_order = true, .work = taking({{0, [&] { race.after_first(); }}})}});
}

/// Of an item in a stage that is in order, and the entrance, which is another. The second thread waits outside of the
/// pipeline, because in a stage it would come after the first.
void race_with_entrance(Race& race) {
  const auto second_enters = taking({{1, [&] { race.before_second(), race.second(); }}});
  const auto enter = [&](std::size_t item) {
    second_enters(item);
    return enter_two(item);
  };
  parallel_for(2, 1, [&, caller = std::this_thread::get_id()](std::size_t, std::size_t) {
    if (std::this_thread::get_id() != caller) return race.before_second();
    run_pipeline(2, enter,
                 {{.in_order = true, .work = taking({{0, [&] { race.first(); }}})},
                  {.in_order = true, .work = taking({{0, [&] { race.after_first(); }}})}});
  });
}

}  // namespace

int main(int count, char** arguments) {
  const std::map<std::string, std::function<void(Race&)>> races = {{"chunks", race_of_chunks},
                                                                   {"items", race_of_items},
                                                                   {"stages", race_of_stages},
                                                                   {"entrance", race_with_entrance}};
  if (std::thread::hardware_concurrency() < 2) {
    std::puts("skipped: one core, on which no two threads meet");
    return 0;
  }
  Race race;
  with_threads(2, [&] { races.at(count > 1 ? arguments[1] : "")(race); });
  std::printf("shared = %d\n", race.shared);
}
