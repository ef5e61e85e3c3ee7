#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dataset/run/options.h"
#include "io/config/config.h"

namespace thermal {

/// The config's clips that a run makes. ConfigError for an unknown id.
[[nodiscard]] std::vector<ClipConfig> choose_clips(const Config& config, const std::vector<std::string>& ids,
                                                   const Shard& shard);

/// The ids of clips, in their order.
[[nodiscard]] std::vector<std::string> ids_of(const std::vector<ClipConfig>& clips);

/// How many frames the clips have together.
[[nodiscard]] int frames_of(const std::vector<ClipConfig>& clips);

/// Positions of these clips in the config: the part of its folder that a run locks.
[[nodiscard]] std::vector<std::size_t> places_of(const Config& config, const std::vector<ClipConfig>& clips);

}  // namespace thermal
