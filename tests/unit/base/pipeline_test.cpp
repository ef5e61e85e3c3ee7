#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "base/parallel.h"
#include "support/catch.h"

namespace pipeline_test {

using namespace thermal;

namespace {

constexpr std::size_t kInFlight = 3;

/// 0, 1, 2, … below `count`.
std::vector<std::size_t> numbers(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

TEST_CASE("Every item passes every stage once, and stages in order take the items in order") {
  const auto count = GENERATE(as<std::size_t>{}, 0, 1, 2, 50);
  const int threads = GENERATE(1, 2, 4);
  std::vector<std::size_t> entered;
  std::vector<int> visits(count);
  std::vector<std::size_t> in_the_middle;
  std::vector<std::size_t> through;
  const auto enter = [&](std::size_t item) {
    if (item == count) return false;
    entered.push_back(item);
    return true;
  };
  with_threads(threads, [&] {
    run_pipeline(kInFlight, enter,
                 {{.in_order = false, .work = [&](std::size_t item) { ++visits[item]; }},
                  {.in_order = true, .work = [&](std::size_t item) { in_the_middle.push_back(item); }},
                  {.in_order = false, .work = [&](std::size_t item) { ++visits[item]; }},
                  {.in_order = true, .work = [&](std::size_t item) { through.push_back(item); }}});
  });
  CHECK(entered == numbers(count));
  CHECK(std::ranges::all_of(visits, [](int n) { return n == 2; }));
  CHECK(in_the_middle == numbers(count));
  CHECK(through == numbers(count));
}

TEST_CASE("What an item has in its slot is its own until it is through") {
  constexpr std::size_t kItems = 200;
  std::array<std::size_t, kInFlight> slots{};
  std::atomic<int> wrong = 0;
  with_threads(4, [&] {
    const auto enter = [&](std::size_t item) {
      if (item == kItems) return false;
      slots[item % kInFlight] = item;
      return true;
    };
    const auto check = [&](std::size_t item) { wrong += slots[item % kInFlight] == item ? 0 : 1; };
    run_pipeline(kInFlight, enter, {{.in_order = false, .work = check}, {.in_order = true, .work = check}});
  });
  CHECK(wrong == 0);
}

TEST_CASE("An exception in any stage, or on entry, ends the pipeline and reaches the caller") {
  const auto at_seven = [](std::size_t item) {
    if (item == 7) throw std::runtime_error("item 7");
  };
  const auto nothing = [](std::size_t) {};
  std::atomic<std::size_t> last = 0;
  const auto enter = [&](std::size_t item) {
    last = item;
    return item < 1000;
  };
  const auto in_order = GENERATE(false, true);
  CHECK_THROWS_WITH(
      run_pipeline(kInFlight, enter,
                   {{.in_order = in_order, .work = at_seven}, {.in_order = true, .work = nothing}}),
      "item 7");
  CHECK(last < 7 + kInFlight);
  const auto enter_until_seven = [&](std::size_t item) {
    at_seven(item);
    return true;
  };
  CHECK_THROWS_WITH(run_pipeline(kInFlight, enter_until_seven, {{.in_order = true, .work = nothing}}),
                    "item 7");
}

}  // namespace pipeline_test
