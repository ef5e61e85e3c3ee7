#pragma once

#include "cli/command.h"
#include "io/pass_reader.h"

namespace veldt {

/// Adds --max-megapixels N to a command that reads passes.
void add_max_megapixels(CLI::App* command, double& max_megapixels);

/// What it says. ConfigError for what is no number of pixels.
[[nodiscard]] thermal::ReadLimits read_limits(double max_megapixels);

}  // namespace veldt
