#pragma once

#include <vector>

#include "cli/command.h"
#include "dataset/convert.h"

namespace veldt {

/// Prints how a run ended, and returns what the program is to exit with.
int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options);

/// The same for a run that made several datasets: a line each, and their variants' names with what was rejected.
int summarise(const std::vector<thermal::ConvertOutcome>& outcomes, const CommonOptions& options);

}  // namespace veldt
