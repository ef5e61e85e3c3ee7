#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/render_suite.h"

namespace thermal {

/// Time and gap of the frame selection for a data set of the published size, with typical bounds: to 1 %, at most 60
/// s each. Every solution is checked with check_balance().
[[nodiscard]] std::vector<RenderRow> run_balance_suite(
    const std::function<void(const std::string&)>& announce);

}  // namespace thermal
