#include "cli/run_summary.h"

#include <cstdio>

#include <fmt/format.h>

namespace veldt {

int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options) {
  for (const auto& [clip, why] : outcome.failed)
    fmt::print(stderr, "veldt: clip {} rejected: {}\n", clip, why);
  const bool nothing_left = outcome.made.empty() && outcome.failed.empty();
  if (!options.quiet && nothing_left) {
    fmt::print("{}: nothing to do, {} clips were there already\n", out.string(),
               outcome.already_there.size());
  } else if (!options.quiet) {
    fmt::print("{}: {} clips made, {} frames", out.string(), outcome.made.size(), outcome.frames_made);
    if (!outcome.already_there.empty()) fmt::print("; {} were there already", outcome.already_there.size());
    fmt::print("{}\n", outcome.complete ? "" : "; the dataset is not complete yet");
  }
  if (outcome.failed.empty()) return kDone;
  return outcome.made.empty() && outcome.already_there.empty() ? kFailed : kSomeRejected;
}

}  // namespace veldt
