#include "dataset/run/shards.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <utility>

#include "dataset/run/estimate.h"

namespace thermal {

std::vector<int> deal_shards(const Config& config, int count) {
  std::vector<std::size_t> order(config.clips.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return config.clips[a].frames > config.clips[b].frames; });
  using Load = std::pair<double, int>;  // seconds, shard; of equal loads the first shard is next
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int shard = 0; shard < count; ++shard) loads.emplace(0.0, shard);
  std::vector<int> shards(config.clips.size());
  for (const std::size_t place : order) {
    const auto [seconds, shard] = loads.top();
    loads.pop();
    shards[place] = shard;
    loads.emplace(seconds + clip_seconds(config, config.clips[place].frames), shard);
  }
  return shards;
}

}  // namespace thermal
