#include "bench/balance_instance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/rng.h"

namespace thermal {
namespace {

/// Random numbers of one video, one after another.
class Dice {
 public:
  Dice(std::uint32_t seed, std::uint32_t video) : key_{seed, video} {}

  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * 0x1p-32 * Philox4x32::generate({count_++, 0, 0, 0}, key_)[0];
  }
  /// low … high
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

}  // namespace thermal
