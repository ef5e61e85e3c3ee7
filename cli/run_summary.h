#pragma once

#include "cli/command.h"
#include "dataset/generate.h"

namespace veldt {

/// Says how a run ended, on standard output; rejected inputs on standard error. Returns the exit code.
int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options);

}  // namespace veldt
