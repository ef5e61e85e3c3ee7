#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/balance/balance.h"
#include "dataset/selection_file.h"

namespace thermal {

/// Labels, and where they were read from.
struct LabelSource {
  std::string path;
  LabelSet labels;
};

/// The videos of all sources, one source after another: videos with equal names in different sources stay separate.
[[nodiscard]] std::vector<BalanceVideo> videos_of(const std::vector<LabelSource>& sources);

/// Selects `count` of these frames of a video, each with the same probability; ascending. Each frame has a random
/// number that is a function of (seed, video, frame), and the frames with the smallest are selected, so that the
/// selection does not depend on other videos and types, and a larger count includes the frames of a smaller one.
[[nodiscard]] std::vector<int> choose_frames(const std::vector<int>& frames, std::int64_t count,
                                             std::uint32_t seed, const std::string& video);

/// The frames of a solution for videos_of(sources).
[[nodiscard]] Selection select_frames(const std::vector<LabelSource>& sources, const BalanceProgram& program,
                                      const BalanceResult& result, std::uint32_t seed);

}  // namespace thermal
