#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "labels/label_set.h"

namespace thermal {

/// A part of a dataset: its name, and its fraction of all labels and pictures.
struct SplitShare {
  std::string name;
  double share = 0;  ///< above 0; those of all splits add up to 1
};

/// Parses "train:0.8,val:0.2". ConfigError "--split = …; expected …" unless names are unique words and shares are
/// above 0 and add up to 1 within 0.001, which allows for rounded thirds.
[[nodiscard]] std::vector<SplitShare> parse_splits(const std::string& text);

/// For videos without pictures.
inline constexpr std::size_t kNoSplit = static_cast<std::size_t>(-1);

/// The split of each video, as index into `shares`: whole videos, never their frames, because neighbouring frames are
/// almost identical. Stratified: among the solutions that give most splits a label of most categories, one in which
/// each split's share of each category's labels, and of pictures, is near the requested one. Found by a greedy start
/// (each video goes to the split that lacks most of its labels; after Sechidis et al., ECML PKDD 2011), improved by
/// moving and swapping videos, from several seeded orders. A function of seed, shares and the names and contents of
/// the videos, not of their order.
/// ConfigError if fewer videos have pictures than there are splits.
[[nodiscard]] std::vector<std::size_t> split_videos(const LabelSet& set,
                                                    const std::vector<SplitShare>& shares,
                                                    std::uint32_t seed);

}  // namespace thermal
