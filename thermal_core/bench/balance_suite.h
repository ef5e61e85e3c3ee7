#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "analysis/balance/program.h"
#include "bench/render_suite.h"

namespace thermal {

/// Synthetic videos like those of a drone; five labels per frame and everything below is an *estimate*: herds and
/// groups of people pass through the view, most of one size within a video, and each animal is missed in some frames.
/// Three videos in ten have both animals and people, a few only people. A function of the seed.
[[nodiscard]] std::vector<BalanceVideo> made_up_videos(std::uint32_t seed, int videos, int frames);

/// Time and gap of the frame selection for a data set of the published size, with typical bounds: to 1 %, at most 60
/// s each. Every solution is checked with check_balance().
[[nodiscard]] std::vector<RenderRow> run_balance_suite(
    const std::function<void(const std::string&)>& announce);

}  // namespace thermal
