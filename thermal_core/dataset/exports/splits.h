#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dataset/exports/split_shares.h"
#include "labels/label_set.h"

namespace thermal {

/// Where a video goes that has no picture: nowhere.
inline constexpr std::size_t kNoSplit = static_cast<std::size_t>(-1);

/// The split of each video, as place in `shares`: whole videos, never their frames, since neighbouring frames are all
/// but the same. Stratified: of the ways that give most splits a label of most categories, one in which each
/// split's share of each category's labels, and of pictures, is near what is asked. Found by a greedy start (each
/// video to the split that lacks most of what it has; after Sechidis et al., ECML PKDD 2011) that is bettered by
/// moving and swapping videos, from several seeded orders. A function of seed, shares and what the videos are called
/// and hold, not of their order.
/// ConfigError if fewer videos have pictures than there are splits.
[[nodiscard]] std::vector<std::size_t> split_videos(const LabelSet& set,
                                                    const std::vector<SplitShare>& shares,
                                                    std::uint32_t seed);

}  // namespace thermal
