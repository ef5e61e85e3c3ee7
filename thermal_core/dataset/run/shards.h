#pragma once

#include <vector>

#include "io/config/config.h"

namespace thermal {

/// One of `count` parts of a dataset's clips, which are made separately: 0 <= index < count.
struct Shard {
  int index = 0;
  int count = 1;
};

/// The shard of each of a config's clips, by its position. Shards cost nearly the same: the most expensive clips are
/// dealt first, each to the shard with the least work so far, so that no two shards differ by more than the most
/// expensive clip. Depends on the clips' frames and the number of shards alone, so that every machine deals alike.
/// @param count  of shards, at least 1; with more shards than clips, some get none
[[nodiscard]] std::vector<int> deal_shards(const Config& config, int count);

}  // namespace thermal
