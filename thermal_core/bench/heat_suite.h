#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/render_suite.h"
#include "scene/material.h"

namespace thermal {

/// The heat balance on one thread: the day of a column by steps and layers, with its error against much finer ones;
/// tables of a day; their error against the balance solved for each exposure; and the emission of a frame of 640 x 512
/// by tables and maps beside that of Table 1. Takes about ten seconds.
[[nodiscard]] std::vector<RenderRow> run_heat_suite(const MaterialLibrary& materials,
                                                    const std::function<void(const std::string&)>& announce);

}  // namespace thermal
