#include "analysis/balance/balance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/balance/search.h"
#include "analysis/balance/solver.h"
#include "base/error.h"

namespace thermal {
namespace {

/// Frames with the same labels, of all videos together.
std::map<ClassCounts, std::int64_t> pooled_types(const BalanceProgram& program) {
  std::map<ClassCounts, std::int64_t> pooled;
  for (const BalanceVideo& video : program.videos) {
    for (const FrameType& type : video.types)
      pooled[type.labels] += static_cast<std::int64_t>(type.frames.size());
  }
  return pooled;
}

/// Minimises the number of labels below and above the bounds. The first columns are the types, in their order. Each
/// sum of labels is its greatest common divisor times a whole number; the model states this, because the search would
/// otherwise have to discover it.
IntegerProgram pooled_program(const std::map<ClassCounts, std::int64_t>& pooled,
                              const std::array<ClassBounds, kBalanceClasses>& bounds) {
  IntegerProgram program;
  std::array<IntegerProgram::Row, kBalanceClasses> sums;
  ClassCounts steps{};
  for (const auto& [labels, frames] : pooled) {
    const std::size_t column = program.add({.upper = static_cast<double>(frames), .whole = true});
    for (std::size_t k = 0; k < kBalanceClasses; ++k) {
      if (labels[k] > 0) sums[k].terms.push_back({column, static_cast<double>(labels[k])});
      steps[k] = std::gcd(steps[k], labels[k]);
    }
  }
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    const auto step = static_cast<double>(std::max<std::int64_t>(1, steps[k]));
    const std::size_t sum = program.add({.whole = true});
    const std::size_t below = program.add({.cost = 1, .whole = true});
    const std::size_t above = program.add({.cost = 1, .whole = true});
    sums[k].terms.push_back({sum, -step});
    sums[k].lower = sums[k].upper = 0;
    program.rows.push_back(sums[k]);
    program.rows.push_back(
        {.lower = static_cast<double>(bounds[k].at_least), .terms = {{sum, step}, {below, 1}}});
    program.rows.push_back(
        {.upper = static_cast<double>(bounds[k].at_most), .terms = {{sum, step}, {above, -1}}});
  }
  return program;
}

/// Assigns the frames of each pooled type to the videos that have it, in order.
std::vector<std::vector<std::int64_t>> share_out(const BalanceProgram& program,
                                                 std::map<ClassCounts, std::int64_t> frames) {
  std::vector<std::vector<std::int64_t>> taken;
  for (const BalanceVideo& video : program.videos) {
    taken.emplace_back();
    for (const FrameType& type : video.types) {
      std::int64_t& left = frames[type.labels];
      taken.back().push_back(std::min(left, static_cast<std::int64_t>(type.frames.size())));
      left -= taken.back().back();
    }
  }
  return taken;
}

std::int64_t missed(const ClassBounds& bounds, std::int64_t labels) {
  return std::max<std::int64_t>({0, bounds.at_least - labels, labels - bounds.at_most});
}

ClassCounts all_available(const BalanceProgram& program) {
  ClassCounts sums{};
  for (const BalanceVideo& video : program.videos) {
    const ClassCounts there = video.available();
    for (std::size_t k = 0; k < kBalanceClasses; ++k) sums[k] += there[k];
  }
  return sums;
}

}  // namespace

NearestBounds nearest_bounds(const BalanceProgram& program, double time_limit_s) {
  std::map<ClassCounts, std::int64_t> pooled = pooled_types(program);
  const SolverResult solved = solve(pooled_program(pooled, program.bounds), {.time_s = time_limit_s});
  if (solved.end != SolverEnd::solved)
    throw ConfigError(fault("time_limit_s", fmt::format("{}", time_limit_s), "s",
                            "more; it is still unknown whether the bounds can be met"));
  std::size_t column = 0;
  for (auto& [labels, frames] : pooled) frames = std::llround(solved.values[column++]);
  NearestBounds nearest;
  for (const auto& [labels, frames] : pooled) {
    for (std::size_t k = 0; k < kBalanceClasses; ++k) nearest.labels[k] += labels[k] * frames;
  }
  for (std::size_t k = 0; k < kBalanceClasses; ++k)
    nearest.missed_by += missed(program.bounds[k], nearest.labels[k]);
  nearest.taken = share_out(program, std::move(pooled));
  return nearest;
}

std::vector<std::string> bounds_not_met(const BalanceProgram& program, const NearestBounds& nearest) {
  const ClassCounts there = all_available(program);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    const ClassBounds& bounds = program.bounds[k];
    const std::int64_t labels = nearest.labels[k];
    if (missed(bounds, labels) == 0) continue;
    std::string line = fmt::format("per-class {}: ", balance_class_names()[k]);
    if (there[k] < bounds.at_least)
      line += fmt::format("at least {} requested, {} available", bounds.at_least, there[k]);
    else if (labels < bounds.at_least)
      line += fmt::format("at least {} requested", bounds.at_least);
    else
      line += fmt::format("at most {} requested", bounds.at_most);
    if (labels != there[k] || labels >= bounds.at_least)
      line += fmt::format(", {} {} possible with the other bounds",
                          labels < bounds.at_least ? "at most" : "at least", labels);
    lines.push_back(line);
  }
  return lines;
}

BalanceResult balance(const BalanceProgram& program, const BalanceOptions& options) {
  options.validate();
  const Deadline deadline(options.time_limit_s);
  NearestBounds nearest = nearest_bounds(program, options.time_limit_s);
  if (nearest.missed_by > 0)
    throw ConfigError(fmt::format("{}", fmt::join(bounds_not_met(program, nearest), "\n")));
  BalanceResult result = search_balance(program, std::move(nearest.taken), options.gap, deadline);
  const std::vector<std::string> faults = check_balance(program, result.solution);
  if (!faults.empty())
    throw Error(fmt::format("the solution violates the program: {}", fmt::join(faults, "; ")));
  return result;
}

}  // namespace thermal
