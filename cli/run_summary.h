#pragma once

#include <vector>

#include "cli/command.h"
#include "dataset/run/convert.h"

namespace veldt {

/// Share of unusable depth or normals above which a clip counts as rejected.
inline constexpr double kMostUnusable = 0.01;

/// Adds --max-unusable-share. ConfigError at check_max_unusable() unless from 0 to 1.
void add_max_unusable(Command& command, double& max_unusable_share);
void check_max_unusable(double max_unusable_share);

/// Warns of temporary files and folders that could not be removed. They do not affect the data, nor the exit code.
void print_left_over(const std::vector<thermal::LeftOver>& left_over);

/// Prints the result of a run, and returns the exit code. `done`: what was done to its clips. Unusable depth and
/// normals are reported on standard error; above the share the exit code is that of rejected inputs.
int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options,
              const std::string& done = "made", double max_unusable_share = kMostUnusable);

/// The same for a run that made several datasets: a line each, and the rejected clips of each variant, by its name.
/// Frames skipped in several datasets are listed once.
int summarise(const std::vector<thermal::ConvertOutcome>& outcomes, const CommonOptions& options,
              double max_unusable_share);

}  // namespace veldt
