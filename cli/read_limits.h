#pragma once

#include "cli/command.h"
#include "io/pass_reader.h"

namespace veldt {

/// Adds --max-megapixels N to a command that reads passes.
void add_max_megapixels(CLI::App* command, double& max_megapixels);

/// The limits of --max-megapixels. ConfigError if it is not a number of pixels.
[[nodiscard]] thermal::ReadLimits read_limits(double max_megapixels);

}  // namespace veldt
