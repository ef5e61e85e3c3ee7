#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/render_suite.h"

namespace thermal {

/// The whole product against an independent ground truth that shares no code with it: silhouettes of known temperature,
/// a lens with a round aperture wavelength by wavelength, and exposure over a pixel's time constant while camera and
/// target move. Errors of apparent temperature over the target's pixels, of the target's signal, and the time of a
/// frame; each of target, distance, speed, frame rate, sampling and optics varied around a person at 122 m. Takes about
/// a minute.
/// @param only  one of truth_groups(); empty: all
[[nodiscard]] std::vector<RenderRow> run_truth_suite(const std::function<void(const std::string&)>& announce,
                                                     const std::string& only = "");

/// Groups of its rows.
[[nodiscard]] const std::vector<std::string>& truth_groups();

}  // namespace thermal
