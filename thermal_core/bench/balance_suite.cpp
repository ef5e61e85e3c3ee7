#include "bench/balance_suite.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "analysis/balance/balance.h"
#include "base/rng.h"

namespace thermal {
namespace {

/// Random numbers of one video, in order.
class Dice {
 public:
  Dice(std::uint32_t seed, std::uint32_t video) : key_{seed, video} {}

  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * 0x1p-32 * Philox4x32::generate({count_++, 0, 0, 0}, key_)[0];
  }
  /// A whole number from low to high.
  int whole(int low, int high) { return low + static_cast<int>(uniform(0, high - low + 1)); }
  bool chance(double probability) { return uniform(0, 1) < probability; }

 private:
  Philox4x32::Key key_;
  std::uint32_t count_ = 0;
};

using Counts = std::vector<ClassCounts>;  // one per frame

/// A group enters the view, its members within a few frames of each other, and leaves it again.
void pass_by(Dice& dice, std::size_t of, int members, Counts& counts) {
  const auto frames = static_cast<double>(counts.size());
  constexpr double kApart = 30;     // frames between members
  constexpr double kMissed = 0.03;  // fraction of the frames
  const double begin = dice.uniform(-0.2, 0.9) * frames;
  const double end = begin + dice.uniform(0.05, 0.6) * frames;
  for (int member = 0; member < members; ++member) {
    const double first = std::clamp(begin + dice.uniform(-kApart, kApart), 0.0, frames);
    const double last = std::clamp(end + dice.uniform(-kApart, kApart), 0.0, frames);
    for (auto frame = static_cast<std::size_t>(first); frame < static_cast<std::size_t>(last); ++frame) {
      if (!dice.chance(kMissed)) ++counts[frame][of];
    }
  }
}

Counts make_counts(Dice& dice, int frames) {
  Counts counts(static_cast<std::size_t>(frames));
  const bool animals = dice.chance(0.85);
  const bool people = !animals || dice.chance(0.35);
  const int usual = dice.whole(0, 2);  // size of most targets: the flight's height
  const auto size = [&] { return static_cast<std::size_t>(dice.chance(0.2) ? dice.whole(0, 2) : usual); };
  const int herds = animals ? dice.whole(2, 4) : 0;
  const int groups = people ? dice.whole(1, 4) : 0;
  for (int herd = 0; herd < herds; ++herd) pass_by(dice, size(), dice.whole(2, 11), counts);
  for (int group = 0; group < groups; ++group) pass_by(dice, 3 + size(), dice.whole(1, 5), counts);
  return counts;
}

BalanceVideo sort_into_types(std::string name, const Counts& counts) {
  std::map<ClassCounts, std::vector<int>> found;
  for (std::size_t frame = 0; frame < counts.size(); ++frame)
    found[counts[frame]].push_back(static_cast<int>(frame));
  BalanceVideo video{.name = std::move(name), .types = {}, .unlabelled = 0};
  for (auto& [labels, frames] : found) {
    if (labels == ClassCounts{})
      video.unlabelled = frames.size();
    else
      video.types.push_back({labels, std::move(frames)});
  }
  return video;
}

}  // namespace

std::vector<BalanceVideo> made_up_videos(std::uint32_t seed, int videos, int frames) {
  std::vector<double> lengths;
  for (int i = 0; i < videos; ++i)
    lengths.push_back(Dice(seed, static_cast<std::uint32_t>(videos + i)).uniform(0.4, 1.6));
  const double all = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<BalanceVideo> made;
  double before = 0;
  for (int i = 0; i < videos; ++i) {
    Dice dice(seed, static_cast<std::uint32_t>(i));
    const double after = before + lengths[static_cast<std::size_t>(i)];
    const auto until = [&](double share) { return static_cast<int>(std::lround(share / all * frames)); };
    made.push_back(
        sort_into_types(fmt::format("video_{:02}", i), make_counts(dice, until(after) - until(before))));
    before = after;
  }
  return made;
}

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

/// Bounds as fractions of each class.
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
