#pragma once

#include "io/assets.h"
#include "io/json/file.h"

namespace thermal {

/// The days around the flights of a dataset, by its config, as JSON: for each season `season`, `flown_h` (from and to,
/// in local solar time), `step_h`, `air_k` and `materials_k`, temperatures of open level surfaces at 0:00, step_h, …
/// 24:00. Empty without temperatures by the heat balance, or for a config of an unsupported version.
[[nodiscard]] Json day_figures(const Json& config, const Assets& assets);

}  // namespace thermal
