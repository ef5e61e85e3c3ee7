#include "bench/balance_suite.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "analysis/balance.h"
#include "bench/balance_instance.h"

namespace thermal {
namespace {

constexpr std::uint32_t kBalanceSeed = 1;
constexpr int kVideos = 70;  // both as in the published data set
constexpr int kFramesAVideo = 40000;

ClassCounts sums_of(const std::vector<BalanceVideo>& videos) {
  ClassCounts sums{};
  for (const BalanceVideo& video : videos) {
    const ClassCounts there = video.available();
    for (std::size_t k = 0; k < kBalanceClasses; ++k) sums[k] += there[k];
  }
  return sums;
}

/// The same bounds for all classes, as fractions of the rarest.
std::array<ClassBounds, kBalanceClasses> alike(const ClassCounts& there, double low, double high) {
  const auto rarest = static_cast<double>(*std::min_element(there.begin(), there.end()));
  std::array<ClassBounds, kBalanceClasses> bounds;
  bounds.fill({.at_least = std::llround(low * rarest), .at_most = std::llround(high * rarest)});
  return bounds;
}

/// Fractions of each class.
std::array<ClassBounds, kBalanceClasses> shares(const ClassCounts& there, double low, double high) {
  std::array<ClassBounds, kBalanceClasses> bounds;
  for (std::size_t k = 0; k < kBalanceClasses; ++k) {
    const auto all = static_cast<double>(there[k]);
    bounds[k] = {.at_least = std::llround(low * all), .at_most = std::llround(high * all)};
  }
  return bounds;
}

RenderRow solved_row(const std::string& name, const BalanceProgram& program) {
  const auto begin = std::chrono::steady_clock::now();
  const BalanceResult result = balance(program, {.gap = 0.01, .time_limit_s = 60});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::int64_t labels = 0;
  std::int64_t frames = 0;
  for (std::size_t i = 0; i < program.videos.size(); ++i) {
    for (const std::int64_t count : result.solution.labels_of(program, i)) labels += count;
    for (const std::int64_t count : result.solution.taken[i]) frames += count;
  }
  return {"selection to 1 %",
          name,
          {{"labels", static_cast<double>(labels)},
           {"frames", static_cast<double>(frames)},
           {"objective", static_cast<double>(result.solution.objective)},
           {"bound", static_cast<double>(result.bound)},
           {"gap_percent", 100 * result.gap},
           {"s", took.count()}}};
}

RenderRow instance_row(const std::vector<BalanceVideo>& videos) {
  std::size_t types = 0;
  std::size_t frames = 0;
  for (const BalanceVideo& video : videos) {
    types += video.types.size();
    frames += video.unlabelled;
    for (const FrameType& type : video.types) frames += type.frames.size();
  }
  RenderRow row{"to choose from",
                "synthetic, of published size",
                {{"videos", static_cast<double>(videos.size())},
                 {"frames", static_cast<double>(frames)},
                 {"frame_types", static_cast<double>(types)}}};
  const ClassCounts there = sums_of(videos);
  for (std::size_t k = 0; k < kBalanceClasses; ++k)
    row.figures.push_back({balance_class_names()[k], static_cast<double>(there[k])});
  return row;
}

}  // namespace

std::vector<RenderRow> run_balance_suite(const std::function<void(const std::string&)>& announce) {
  BalanceProgram program{.videos = made_up_videos(kBalanceSeed, kVideos, kFramesAVideo), .bounds = {}};
  const ClassCounts there = sums_of(program.videos);
  std::vector<RenderRow> rows = {instance_row(program.videos)};
  const auto measure = [&](const std::string& name, const std::array<ClassBounds, kBalanceClasses>& bounds) {
    announce(name);
    program.bounds = bounds;
    rows.push_back(solved_row(name, program));
  };
  measure("half of the rarest, of each", alike(there, 0.5, 0.6));
  measure("nearly all of the rarest", alike(there, 0.9, 1.1));
  measure("a third of each class", shares(there, 0.3, 0.4));
  measure("two thirds of each class", shares(there, 0.6, 0.7));
  measure("a tenth to all of the rarest", alike(there, 0.1, 1));
  measure("an exact number of each", alike(there, 0.3, 0.3));
  return rows;
}

}  // namespace thermal
