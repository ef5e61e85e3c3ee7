#pragma once

#include <vector>

#include "cli/command.h"
#include "dataset/run/convert.h"

namespace veldt {

/// Share of unusable depth or normals above which a clip counts as rejected.
inline constexpr double kMostUnusable = 0.01;

/// --max-unusable-share. ConfigError at check_max_unusable() unless from 0 to 1.
void add_max_unusable(CLI::App* command, double& max_unusable_share);
void check_max_unusable(double max_unusable_share);

/// Warns of temporary files and folders that stay. The data do not need them gone, so the exit code stays what it is.
void print_left_over(const std::vector<thermal::LeftOver>& left_over);

/// Prints how a run ended, and returns the exit code. `done`: what was done to its clips.
/// Unusable depth and normals are reported on standard error; above the share the exit code is that of rejected inputs.
int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options,
              const std::string& done = "made", double max_unusable_share = kMostUnusable);

/// The same for a run that made several datasets: a line each, and what each variant rejected, by its name. Skipped
/// frames are listed once, however many datasets lack them.
int summarise(const std::vector<thermal::ConvertOutcome>& outcomes, const CommonOptions& options,
              double max_unusable_share);

}  // namespace veldt
