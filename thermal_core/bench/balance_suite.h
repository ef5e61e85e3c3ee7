#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/render_suite.h"

namespace thermal {

/// Time beside gap of the frame selection for a data set of the published size, with bounds as people ask for them:
/// to 1 %, at most 60 s each. Every solution has passed check_balance().
[[nodiscard]] std::vector<RenderRow> run_balance_suite(const std::function<void(const std::string&)>& tell);

}  // namespace thermal
