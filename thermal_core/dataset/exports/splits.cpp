#include "dataset/exports/splits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/rng.h"
#include "base/text.h"

namespace thermal {
namespace {

bool is_word(const std::string& name) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !name.empty() && name.find_first_not_of(kLetters) == std::string::npos;
}

std::optional<SplitShare> parse_split(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || !is_word(text.substr(0, colon))) return std::nullopt;
  const std::optional<double> share = number_in<double>(std::string_view(text).substr(colon + 1));
  if (!share || !(*share > 0) || *share > 1) return std::nullopt;
  return SplitShare{.name = text.substr(0, colon), .share = *share};
}

[[noreturn]] void refuse_splits(const std::string& text) {
  throw ConfigError(
      fault("--split", text, "",
            "NAME:SHARE,NAME:SHARE…, names that differ and shares above 0 that add up to 1, e.g. "
            "train:0.8,val:0.2"));
}

}  // namespace

std::vector<SplitShare> parse_splits(const std::string& text) {
  std::vector<SplitShare> splits;
  std::set<std::string> names;
  double sum = 0;
  for (const std::string_view part : split(text, ',')) {
    const std::optional<SplitShare> split_share = parse_split(std::string(part));
    if (!split_share || !names.insert(split_share->name).second) refuse_splits(text);
    splits.push_back(*split_share);
    sum += split_share->share;
  }
  constexpr double kSlack = 0.001;
  if (std::abs(sum - 1) > kSlack) refuse_splits(text);
  for (SplitShare& split : splits) split.share /= sum;
  return splits;
}

namespace {

/// Counts: labels of each category, and pictures last.
using Counts = std::vector<double>;

/// Cost of a split: how many splits lack an existing category, then squared errors of shares.
struct Cost {
  int missing = 0;
  double error = 0;

  Cost& operator+=(const Cost& other) {
    missing += other.missing;
    error += other.error;
    return *this;
  }
  /// By more than rounding errors, so that a search terminates.
  [[nodiscard]] bool is_better_than(const Cost& other) const {
    constexpr double kRoundings = 1e-12;
    return missing != other.missing ? missing < other.missing : error < other.error - kRoundings;
  }
};

/// The videos to distribute; without those that have no picture.
struct Clips {
  std::vector<std::size_t> videos;  ///< index of each in the label set, by name
  std::vector<Counts> counts;
  Counts total;
};

Clips counts_of(const LabelSet& set) {
  std::vector<Counts> counts(set.videos.size(), Counts(set.categories.size() + 1, 0));
  for (const LabelImage& image : set.images) counts[image.video].back() += 1;
  for (const Label& label : set.labels) counts[set.images[label.image].video][label.category] += 1;
  Clips clips;
  clips.total.resize(set.categories.size() + 1, 0);
  for (std::size_t video = 0; video < counts.size(); ++video) {
    if (counts[video].back() > 0) clips.videos.push_back(video);
  }
  std::ranges::sort(clips.videos, {}, [&set](std::size_t video) { return set.videos[video].name; });
  for (const std::size_t video : clips.videos) {
    clips.counts.push_back(counts[video]);
    std::ranges::transform(clips.total, counts[video], clips.total.begin(), std::plus());
  }
  return clips;
}

/// A random order of clips for each seed and start.
std::vector<std::size_t> shuffled(const LabelSet& set, const Clips& clips, std::uint32_t seed,
                                  std::size_t start) {
  constexpr std::uint32_t kSplitStream = 1000;  // after those of sensor/streams.h
  std::vector<std::pair<float, std::size_t>> keys;
  for (std::size_t i = 0; i < clips.videos.size(); ++i) {
    std::array<float, kRandomBatch> random{};
    fill_uniform(
        {seed, kSplitStream, hash_name(set.videos[clips.videos[i]].name), static_cast<std::uint32_t>(start)},
        0, random);
    keys.emplace_back(random[0], i);
  }
  std::ranges::sort(keys);
  std::vector<std::size_t> order;
  for (const auto& [key, i] : keys) order.push_back(i);
  return order;
}

/// With few clips there are few good solutions, which a search may miss; with many, all results are similar.
std::size_t starts_for(std::size_t clips) { return std::clamp<std::size_t>(4000 / clips, 4, 100); }

/// A solution that is being improved.
class Assignment {
 public:
  Assignment(const Clips& clips, const std::vector<SplitShare>& shares)
      : clips_(clips),
        shares_(shares),
        of_clip_(clips.videos.size(), kNoSplit),
        got_(shares.size(), Counts(clips.total.size(), 0)),
        clips_in_(shares.size(), 0) {}

  /// Greedy start: each clip goes to the split whose shares it improves most.
  void fill(const std::vector<std::size_t>& order) {
    for (std::size_t left = order.size(); const std::size_t clip : order) {
      put(clip, best_split_for(clip, left));
      --left;
    }
  }

  /// Moves and swaps clips until no single step improves the cost.
  void improve() {
    while (move_some() || swap_some()) {
    }
  }

  [[nodiscard]] Cost cost() const {
    Cost sum;
    for (std::size_t split = 0; split < shares_.size(); ++split) sum += cost_of(split);
    return sum;
  }
  [[nodiscard]] const std::vector<std::size_t>& of_clip() const { return of_clip_; }

 private:
  [[nodiscard]] Cost cost_of(std::size_t split) const {
    Cost cost;
    for (std::size_t k = 0; k < clips_.total.size(); ++k) {
      if (clips_.total[k] == 0) continue;
      const double error = got_[split][k] / clips_.total[k] - shares_[split].share;
      cost.error += error * error;
      if (got_[split][k] == 0) ++cost.missing;
    }
    return cost;
  }

  void add(std::size_t clip, std::size_t split, double sign) {
    for (std::size_t k = 0; k < clips_.total.size(); ++k) got_[split][k] += sign * clips_.counts[clip][k];
  }

  void put(std::size_t clip, std::size_t split) {
    if (const std::size_t before = std::exchange(of_clip_[clip], split); before != kNoSplit) {
      add(clip, before, -1);
      --clips_in_[before];
    }
    add(clip, split, 1);
    ++clips_in_[split];
  }

  /// Gives every split a clip: when as many clips are left as splits are empty, only empty splits are candidates.
  [[nodiscard]] std::size_t best_split_for(std::size_t clip, std::size_t clips_left) {
    const auto empty = static_cast<std::size_t>(std::ranges::count(clips_in_, 0));
    std::optional<std::pair<double, std::size_t>> best;
    for (std::size_t split = 0; split < shares_.size(); ++split) {
      if (clips_left <= empty && clips_in_[split] > 0) continue;
      const double before = cost_of(split).error;
      add(clip, split, 1);
      const double added = cost_of(split).error - before;
      add(clip, split, -1);
      if (!best || added < best->first) best = {added, split};
    }
    return best->second;
  }

  /// Cost of two splits after `change`, which stays if it is an improvement, and is otherwise reverted by `undo`.
  template <typename Change, typename Undo>
  bool keep_if_better(std::size_t one, std::size_t other, const Change& change, const Undo& undo) {
    Cost before = cost_of(one);
    before += cost_of(other);
    change();
    Cost after = cost_of(one);
    after += cost_of(other);
    if (after.is_better_than(before)) return true;
    undo();
    return false;
  }

  bool move_some() {
    bool moved = false;
    for (std::size_t clip = 0; clip < of_clip_.size(); ++clip) {
      for (std::size_t to = 0; to < shares_.size(); ++to) {
        const std::size_t from = of_clip_[clip];
        if (to == from || clips_in_[from] == 1) continue;
        moved |= keep_if_better(
            from, to, [&] { put(clip, to); }, [&] { put(clip, from); });
      }
    }
    return moved;
  }

  bool swap_some() {
    constexpr std::size_t kMostClips = 500;  // with more, single moves suffice
    if (of_clip_.size() > kMostClips) return false;
    bool swapped = false;
    for (std::size_t a = 0; a < of_clip_.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) swapped |= swap_if_better(a, b);
    }
    return swapped;
  }

  bool swap_if_better(std::size_t a, std::size_t b) {
    const std::size_t of_a = of_clip_[a];
    const std::size_t of_b = of_clip_[b];
    const auto set = [&](std::size_t to_a, std::size_t to_b) {
      put(a, to_a);
      put(b, to_b);
    };
    return of_a != of_b && keep_if_better(
                               of_a, of_b, [&] { set(of_b, of_a); }, [&] { set(of_a, of_b); });
  }

  const Clips& clips_;
  const std::vector<SplitShare>& shares_;
  std::vector<std::size_t> of_clip_;
  std::vector<Counts> got_;  ///< by split
  std::vector<int> clips_in_;
};

}  // namespace

std::vector<std::size_t> split_videos(const LabelSet& set, const std::vector<SplitShare>& shares,
                                      std::uint32_t seed) {
  const Clips clips = counts_of(set);
  if (clips.videos.size() < shares.size())
    throw ConfigError(
        fmt::format("--split = {} splits; expected no more than there are clips with pictures, {}: "
                    "frames of one clip never go to several splits",
                    shares.size(), clips.videos.size()));
  std::optional<Assignment> best;
  for (std::size_t start = 0; start < starts_for(clips.videos.size()); ++start) {
    Assignment next(clips, shares);
    next.fill(shuffled(set, clips, seed, start));
    next.improve();
    if (!best || next.cost().is_better_than(best->cost())) best.emplace(next);
  }
  std::vector<std::size_t> of_video(set.videos.size(), kNoSplit);
  for (std::size_t i = 0; i < clips.videos.size(); ++i) of_video[clips.videos[i]] = best->of_clip()[i];
  return of_video;
}

}  // namespace thermal
