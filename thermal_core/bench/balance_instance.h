#pragma once

#include <cstdint>
#include <vector>

#include "analysis/frame_types.h"

namespace thermal {

/// Videos as a drone brings them home, made up; five labels a frame and all that follows is an *estimate*: herds and
/// groups of people pass through the view, most of one size in a video, every animal of them missed in some frames.
/// Three videos in ten have both animals and people, a few have people alone. A function of the seed.
[[nodiscard]] std::vector<BalanceVideo> made_up_videos(std::uint32_t seed, int videos, int frames);

}  // namespace thermal
