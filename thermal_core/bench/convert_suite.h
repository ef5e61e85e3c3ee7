#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/convert_row.h"
#include "scene/material.h"

namespace thermal {

/// The converter from files of passes to frames and labels, in a temporary folder: what the machine allows, what each
/// stage takes in one thread, and what clips take from end to end, at 640 x 512 and 3840 x 3072. `tell` hears what is
/// measured next. IoError if the folder cannot be written.
[[nodiscard]] std::vector<ConvertRow> run_convert_suite(const MaterialLibrary& materials,
                                                        const std::function<void(const std::string&)>& tell);

}  // namespace thermal
