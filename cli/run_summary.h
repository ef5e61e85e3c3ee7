#pragma once

#include <vector>

#include "cli/command.h"
#include "dataset/convert.h"

namespace veldt {

/// Prints how a run ended, and returns what the program is to exit with. `done`: what was done to its clips.
int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options,
              const std::string& done = "made");

/// The same for a run that made several datasets: a line each, and their variants' names with what was rejected. Frames
/// that were skipped are named once, whatever datasets go without them.
int summarise(const std::vector<thermal::ConvertOutcome>& outcomes, const CommonOptions& options);

}  // namespace veldt
