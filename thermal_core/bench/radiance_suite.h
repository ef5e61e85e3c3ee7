#pragma once

#include <vector>

#include "bench/measure.h"
#include "scene/material.h"

namespace thermal {

/// Speed and error of everything between a temperature and the radiance at the sensor: evaluators, inverses, terms
/// one by one and together on a 640 x 512 frame, supersampling of a person at 122 m. One thread. Every error is
/// measured before anything is timed.
[[nodiscard]] std::vector<BenchRow> run_radiance_suite(const MaterialLibrary& materials);

}  // namespace thermal
