#pragma once

#include <string>
#include <vector>

#include "bench/render_suite.h"
#include "bench/truth_case.h"

namespace thermal {

/// What each term of the shipped chain is worth: the truth with that term as shipped, against the truth. Sampling: rays
/// as shipped through exact optics. Band: wavelengths weighted as of 300 K. Lag: whole frames mixed instead of
/// exposure; again with the image moved to where a pixel's mean delay puts it, so that only the smear's shape is
/// missing. Optics: the shipped chain with 32 x 32 rays, nothing moving.
[[nodiscard]] std::vector<RenderRow> share_rows(const std::string& group, const TruthCase& usual,
                                                const ContrastKernel& still);

/// How much the truth changes when its steps are twice as fine, one by one and together.
[[nodiscard]] std::vector<RenderRow> convergence_rows(const std::string& group, const TruthCase& usual,
                                                      const ContrastKernel& still);

}  // namespace thermal
