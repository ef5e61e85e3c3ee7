#include "analysis/balance/balance.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "analysis/balance/program.h"
#include "base/error.h"
#include "base/rng.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace balance_test {

using namespace thermal;

namespace {

using Frames = std::vector<std::vector<std::int64_t>>;

FrameType frames_of(const ClassCounts& labels, int count) {
  FrameType type{.labels = labels, .frames = {}};
  for (int frame = 0; frame < count; ++frame) type.frames.push_back(frame);
  return type;
}

/// Random numbers by index: any instance can be regenerated from its number.
class Dice {
 public:
  explicit Dice(std::uint32_t instance) : instance_(instance) {}
  /// 0 … below - 1
  std::int64_t roll(std::int64_t below) {
    const auto word = Philox4x32::generate({count_++, 0, 0, 0}, {instance_, 1})[0];
    return static_cast<std::int64_t>(word) % below;
  }

 private:
  std::uint32_t instance_;
  std::uint32_t count_ = 0;
};

/// Size of random programs.
struct Size {
  std::int64_t videos = 3;
  std::int64_t types = 3;
  std::int64_t frames = 3;
};

BalanceVideo random_video(Dice& dice, const Size& size, std::int64_t number, std::size_t classes) {
  BalanceVideo video{.name = fmt::format("v{}", number), .types = {}, .unlabelled = 0};
  const std::int64_t types = dice.roll(size.types + 1);
  for (std::int64_t j = 0; j < types; ++j) {
    ClassCounts labels{};
    for (std::size_t k = 0; k < classes; ++k) labels[k * 2] = dice.roll(5);
    const auto same = [&](const FrameType& type) { return type.labels == labels; };
    if (labels == ClassCounts{} || std::any_of(video.types.begin(), video.types.end(), same)) continue;
    video.types.push_back(frames_of(labels, static_cast<int>(1 + dice.roll(size.frames))));
  }
  return video;
}

/// Around the counts of a random selection or, one time in five, anywhere.
ClassBounds random_bounds(Dice& dice, std::int64_t some, std::int64_t there) {
  const bool anywhere = dice.roll(5) == 0;
  const std::int64_t low = anywhere ? dice.roll(there + 2) : some - dice.roll(4);
  const std::int64_t high = anywhere ? low + dice.roll(there + 1) : some + dice.roll(6);
  return {.at_least = std::max<std::int64_t>(0, low), .at_most = high};
}

/// Up to this many videos, frame types and frames: few enough to try all selections. Classes share frames, videos are
/// exhausted, and bounds range from free to impossible.
BalanceProgram random_program(std::uint32_t instance, const Size& size = {}) {
  Dice dice(instance);
  BalanceProgram program;
  const auto classes = static_cast<std::size_t>(1 + dice.roll(3));
  const std::int64_t videos = 1 + dice.roll(size.videos);
  ClassCounts there{};
  ClassCounts some{};
  for (std::int64_t i = 0; i < videos; ++i) {
    program.videos.push_back(random_video(dice, size, i, classes));
    for (const FrameType& type : program.videos.back().types) {
      const auto count = static_cast<std::int64_t>(type.frames.size());
      const std::int64_t taken = dice.roll(count + 1);
      for (std::size_t k = 0; k < kBalanceClasses; ++k) {
        there[k] += type.labels[k] * count;
        some[k] += type.labels[k] * taken;
      }
    }
  }
  for (std::size_t k = 0; k < kBalanceClasses; ++k)
    program.bounds[k] = there[k] == 0 ? ClassBounds{} : random_bounds(dice, some[k], there[k]);
  return program;
}

/// The result of trying every selection.
struct Tried {
  std::optional<std::int64_t> objective;  ///< the minimum; empty if no selection is within the bounds
  std::int64_t missed_by = std::numeric_limits<std::int64_t>::max();
};

/// The objective of a selection, reimplemented from the program's definition: u is the largest s; v is the smallest s
/// of videos with labels left, or the most labels of any video if none has any left.
std::int64_t objective_of(const BalanceProgram& program, const Frames& taken) {
  std::int64_t objective = 0;
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    std::int64_t u = 0;
    std::int64_t v = 0;
    for (const BalanceVideo& video : program.videos) v = std::max(v, video.available()[k]);
    for (std::size_t i = 0; i < program.videos.size(); ++i) {
      std::int64_t s = 0;
      for (std::size_t j = 0; j < taken[i].size(); ++j)
        s += taken[i][j] * program.videos[i].types[j].labels[k];
      u = std::max(u, s);
      if (s < program.videos[i].available()[k]) v = std::min(v, s);
    }
    objective += u - v;
  }
  return objective;
}

std::int64_t missed_by(const BalanceProgram& program, const Frames& taken) {
  std::int64_t missed = 0;
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      for (std::size_t j = 0; j < taken[i].size(); ++j)
        sum += taken[i][j] * program.videos[i].types[j].labels[k];
    }
    missed += std::max<std::int64_t>({0, program.bounds[k].at_least - sum, sum - program.bounds[k].at_most});
  }
  return missed;
}

/// Increments by one frame; false past the last selection.
bool next(const BalanceProgram& program, Frames& taken) {
  for (std::size_t i = 0; i < taken.size(); ++i) {
    for (std::size_t j = 0; j < taken[i].size(); ++j) {
      if (++taken[i][j] <= static_cast<std::int64_t>(program.videos[i].types[j].frames.size())) return true;
      taken[i][j] = 0;
    }
  }
  return false;
}

Tried try_all(const BalanceProgram& program) {
  Frames taken;
  for (const BalanceVideo& video : program.videos) taken.emplace_back(video.types.size(), 0);
  Tried tried;
  do {
    const std::int64_t missed = missed_by(program, taken);
    tried.missed_by = std::min(tried.missed_by, missed);
    if (missed > 0) continue;
    const std::int64_t objective = objective_of(program, taken);
    tried.objective = std::min(tried.objective.value_or(objective), objective);
  } while (next(program, taken));
  return tried;
}

}  // namespace

TEST_CASE("the optimum is the one found by trying everything") {
  int zero = 0;
  int above_zero = 0;
  for (std::uint32_t instance = 0; instance < 400; ++instance) {
    CAPTURE(instance);
    const BalanceProgram program = random_program(instance);
    const Tried tried = try_all(program);
    if (!tried.objective) continue;
    ++(*tried.objective > 0 ? above_zero : zero);
    const BalanceResult result = balance(program, {.gap = 0});
    CHECK(result.solution.objective == *tried.objective);
    CHECK(result.bound == *tried.objective);
    CHECK(result.gap == 0);
    CHECK(result.in_time);
    CHECK(check_balance(program, result.solution).empty());
  }
  CHECK(zero > 60);
  CHECK(above_zero > 60);
}

TEST_CASE("the same with more videos, which are rounded a few at a time") {
  int found = 0;
  for (std::uint32_t instance = 0; instance < 60; ++instance) {
    CAPTURE(instance);
    const BalanceProgram program = random_program(instance, {.videos = 8, .types = 1, .frames = 3});
    const Tried tried = try_all(program);
    if (!tried.objective || program.videos.size() < 5) continue;
    ++found;
    const BalanceResult result = balance(program, {.gap = 0});
    CHECK(result.solution.objective == *tried.objective);
    CHECK(result.bound == *tried.objective);
    CHECK(balance(program, {.gap = 0}).solution == result.solution);
  }
  CHECK(found > 20);
}

TEST_CASE("the accepted gap is met, and the gap is reported correctly") {
  for (std::uint32_t instance = 0; instance < 100; ++instance) {
    CAPTURE(instance);
    const BalanceProgram program = random_program(instance);
    const Tried tried = try_all(program);
    if (!tried.objective) continue;
    const BalanceResult result = balance(program, {.gap = 0.3});
    CHECK(result.bound <= *tried.objective);
    CHECK(result.solution.objective >= *tried.objective);
    CHECK(result.gap <= 0.3);
    const auto apart = static_cast<double>(result.solution.objective - result.bound);
    CHECK(result.gap == apart / static_cast<double>(std::max<std::int64_t>(1, result.solution.objective)));
  }
}

TEST_CASE("bounds that cannot be met are detected, and so are the nearest feasible ones") {
  int infeasible = 0;
  for (std::uint32_t instance = 0; instance < 400; ++instance) {
    CAPTURE(instance);
    const BalanceProgram program = random_program(instance);
    const Tried tried = try_all(program);
    const NearestBounds nearest = nearest_bounds(program, 60);
    CHECK(nearest.missed_by == tried.missed_by);
    CHECK(missed_by(program, nearest.taken) == tried.missed_by);
    CHECK(bounds_not_met(program, nearest).empty() == tried.objective.has_value());
    if (tried.objective) continue;
    ++infeasible;
    CHECK_THROWS_AS(balance(program, {}), ConfigError);
  }
  CHECK(infeasible > 30);
}

}  // namespace balance_test
