#pragma once

#include <string>
#include <vector>

#include "bench/render_suite.h"
#include "bench/truth_case.h"

namespace thermal {

/// Error of each term of the shipped chain: the truth with that term as shipped, against the truth. Sampling: rays as
/// shipped through exact optics. Band: wavelengths weighted as for 300 K. Lag: whole frames mixed instead of exposure;
/// again with the image moved by a pixel's mean delay, which leaves the smear's shape. Optics: the shipped chain with
/// 32 x 32 rays, without motion.
[[nodiscard]] std::vector<RenderRow> share_rows(const std::string& group, const TruthCase& usual,
                                                const ContrastKernel& still);

/// Convergence of the truth: changes with steps twice as fine, one by one and together.
[[nodiscard]] std::vector<RenderRow> convergence_rows(const std::string& group, const TruthCase& usual,
                                                      const ContrastKernel& still);

}  // namespace thermal
