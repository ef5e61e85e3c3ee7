#include <algorithm>
#include <numeric>

#include "dataset/run/options.h"
#include "support/catch.h"

namespace shards_test {

using namespace thermal;

namespace {

DatasetSpec clips_of(const std::vector<int>& frames) {
  DatasetSpec spec;
  for (const int count : frames)
    spec.clips.push_back({.id = std::to_string(spec.clips.size()), .frames = count});
  return spec;
}

std::vector<double> loads_of(const DatasetSpec& spec, const std::vector<int>& shards, int count) {
  std::vector<double> loads(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < shards.size(); ++i)
    loads[static_cast<std::size_t>(shards[i])] += clip_seconds(spec, spec.clips[i].frames);
  return loads;
}

}  // namespace

TEST_CASE("Equal clips are dealt in turn") {
  CHECK(deal_shards(clips_of({8, 8, 8, 8, 8}), 2) == std::vector<int>{0, 1, 0, 1, 0});
  CHECK(deal_shards(clips_of({8, 8}), 4) == std::vector<int>{0, 1});
  CHECK(deal_shards(clips_of({}), 3).empty());
}

TEST_CASE("A long clip has a shard to itself where the others weigh as much") {
  CHECK(deal_shards(clips_of({10, 10, 400, 10, 10}), 2) == std::vector<int>{1, 1, 0, 1, 1});
}

TEST_CASE("Two shards differ by no more than the longest clip") {
  std::vector<int> frames(100);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = static_cast<int>(1 + (i * 7919) % 541);
  const DatasetSpec spec = clips_of(frames);
  for (const int count : {1, 2, 7, 40}) {
    const std::vector<double> loads = loads_of(spec, deal_shards(spec, count), count);
    const auto [least, most] = std::ranges::minmax(loads);
    CHECK(most - least <= clip_seconds(spec, std::ranges::max(frames)) * (1 + 1e-12));
  }
}

}  // namespace shards_test
