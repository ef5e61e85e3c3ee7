#include "cli/run_summary.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "cli/skip_lines.h"

namespace veldt {
namespace {

/// "1 clip", "2 clips".
std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// The line that tells of a dataset; `skipped`: frames its clips go without.
std::string summary_of(const thermal::RunOutcome& run, const std::string& done, std::size_t skipped) {
  const std::size_t there = run.already_there.size();
  const std::string were = there == 1 ? "was" : "were";
  const std::string without = skipped > 0 ? fmt::format("; {} skipped", counted(skipped, "frame")) : "";
  if (run.made.empty() && run.failed.empty())
    return fmt::format("nothing to do, {} {} there already{}", counted(there, "clip"), were, without);
  std::string line = fmt::format("{} {}, {}{}", counted(run.made.size(), "clip"), done,
                                 counted(static_cast<std::size_t>(run.frames_made), "frame"), without);
  if (there > 0) line += fmt::format("; {} {} there already", there, were);
  return run.complete ? line : line + "; the dataset is not complete yet";
}

bool has_clips(const thermal::ConvertOutcome& outcome) {
  return !outcome.run.made.empty() || !outcome.run.already_there.empty();
}

bool has_faults(const thermal::ConvertOutcome& outcome) {
  return !outcome.run.failed.empty() || !outcome.skips.empty();
}

std::size_t frames_in(const std::vector<thermal::ClipSkips>& skips) {
  std::size_t frames = 0;
  for (const thermal::ClipSkips& clip : skips) frames += clip.frames.size();
  return frames;
}

/// Names clips that could not be made; `what` was done to them.
void print_failed(const thermal::RunOutcome& run, const std::string& whose, const std::string& what) {
  for (const auto& [clip, why] : run.failed)
    fmt::print(stderr, "veldt: {}clip {} {}: {}\n", whose, clip, what, why);
}

int exit_code_of(const std::vector<thermal::ConvertOutcome>& outcomes) {
  if (std::none_of(outcomes.begin(), outcomes.end(), has_faults)) return kDone;
  return std::any_of(outcomes.begin(), outcomes.end(), has_clips) ? kSomeRejected : kFailed;
}

}  // namespace

int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options,
              const std::string& done) {
  print_failed(outcome, "", "failed");
  if (!options.quiet) fmt::print("{}: {}\n", out.string(), summary_of(outcome, done, 0));
  if (outcome.try_again) return kTryAgain;
  return exit_code_of({{.variant = "", .out = out, .run = outcome, .skips = {}}});
}

int summarise(const std::vector<thermal::ConvertOutcome>& outcomes, const CommonOptions& options) {
  for (const thermal::ConvertOutcome& one : outcomes)
    print_failed(one.run, one.variant.empty() ? "" : one.variant + ": ", "rejected");
  for (const std::string& line : skip_lines(outcomes)) fmt::print(stderr, "veldt: {}\n", line);
  for (const thermal::ConvertOutcome& one : outcomes) {
    if (options.quiet) break;
    const std::string out = one.out.string();
    fmt::print("{}: {}\n", out, summary_of(one.run, "made", frames_in(one.skips)));
    for (const std::string& term : one.left_out) fmt::print("{}: without the term {}\n", out, term);
  }
  return exit_code_of(outcomes);
}

}  // namespace veldt
