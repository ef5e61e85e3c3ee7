#include "cli/run_summary.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/output.h"

namespace veldt {
namespace {

constexpr std::size_t kMostSkipLines = 20;

using Frames = std::vector<thermal::SkippedFrame>;

/// The end of a run of consecutive frames that share a reason.
std::size_t end_of_run(const Frames& frames, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < frames.size() && frames[end].reason == frames[begin].reason &&
         frames[end].frame_index == frames[end - 1].frame_index + 1)
    ++end;
  return end;
}

std::string line_of(const thermal::ClipSkips& clip, std::size_t begin, std::size_t end) {
  const thermal::SkippedFrame& first = clip.frames[begin];
  const thermal::SkippedFrame& last = clip.frames[end - 1];
  const std::string file = thermal::printable((clip.folder / first.file).string());
  if (end == begin + 1)
    return fmt::format("clip {}: frame {} skipped: {}: {}", clip.clip, first.frame_index, file, first.reason);
  return fmt::format("clip {}: frames {} to {} skipped: {} to {}: {}", clip.clip, first.frame_index,
                     last.frame_index, file, thermal::printable(last.file), first.reason);
}

void add_lines(const thermal::ClipSkips& clip, std::vector<std::string>& lines) {
  std::size_t printed = 0;
  std::size_t frame = 0;
  for (; frame < clip.frames.size() && printed < kMostSkipLines; ++printed) {
    const std::size_t end = end_of_run(clip.frames, frame);
    lines.push_back(line_of(clip, frame, end));
    frame = end;
  }
  if (const std::size_t more = clip.frames.size() - frame; more > 0)
    lines.push_back(fmt::format("clip {}: {} more frame{} skipped", clip.clip, more, more == 1 ? "" : "s"));
}

/// "clip one: frame 1 skipped: one/000001.exr: REASON" for every skipped frame; consecutive frames with
/// the same reason share a line, "clip one: frames 1 to 3 skipped: one/000001.exr to 000003.exr: REASON". At most 20
/// lines a clip, then "clip one: 7 more frames skipped". A frame that several datasets skip is listed once.
std::vector<std::string> skip_lines(const std::vector<thermal::ConvertOutcome>& outcomes) {
  std::vector<std::string> lines;
  std::map<std::string, std::vector<Frames>> printed;  // by clip: other datasets may skip other frames
  for (const thermal::ConvertOutcome& outcome : outcomes) {
    for (const thermal::ClipSkips& clip : outcome.skips) {
      std::vector<Frames>& before = printed[clip.clip];
      if (std::find(before.begin(), before.end(), clip.frames) != before.end()) continue;
      before.push_back(clip.frames);
      add_lines(clip, lines);
    }
  }
  return lines;
}

/// "1 clip", "2 clips".
std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// The summary line of a dataset; `skipped`: number of frames its clips skip.
std::string summary_of(const thermal::RunOutcome& run, const std::string& done, std::size_t skipped) {
  const std::size_t there = run.already_there.size();
  const std::string without = skipped > 0 ? fmt::format("; {} skipped", counted(skipped, "frame")) : "";
  if (run.made.empty() && run.failed.empty())
    return fmt::format("nothing to do, {} already existed{}", counted(there, "clip"), without);
  std::string line = fmt::format("{} {}, {}{}", counted(run.made.size(), "clip"), done,
                                 counted(static_cast<std::size_t>(run.frames_made), "frame"), without);
  if (there > 0) line += fmt::format("; {} already existed", there);
  return run.complete ? line : line + "; the dataset is not complete yet";
}

bool has_clips(const thermal::ConvertOutcome& outcome) {
  return !outcome.run.made.empty() || !outcome.run.already_there.empty();
}

bool has_faults(const thermal::ConvertOutcome& outcome, double max_unusable_share) {
  return !outcome.run.failed.empty() || !outcome.skips.empty() ||
         std::ranges::any_of(outcome.run.unusable,
                             [=](const auto& plane) { return plane.share > max_unusable_share; });
}

std::size_t frames_in(const std::vector<thermal::ClipSkips>& skips) {
  std::size_t frames = 0;
  for (const thermal::ClipSkips& clip : skips) frames += clip.frames.size();
  return frames;
}

/// Lists clips that could not be made; `what`: what happened to them.
void print_failed(const thermal::RunOutcome& run, const std::string& whose, const std::string& what) {
  for (const auto& [clip, why] : run.failed) print_error("veldt: {}clip {} {}: {}\n", whose, clip, what, why);
}

/// Lists clips with unusable depth or normals, and the accepted share.
void print_unusable(const thermal::RunOutcome& run, const std::string& whose, double most) {
  for (const auto& [clip, key, share] : run.unusable) {
    const std::string where = fmt::format("{}clip {}: {}", whose, clip, key);
    const std::string value = fmt::format("{:.3g}", share);
    const std::string rule = fmt::format("at most {} (--max-unusable-share)", most);
    print_error("veldt: {}\n", share > most
                                   ? thermal::fault(where, value, "", rule)
                                   : fmt::format("warning: {} = {}, {} is accepted", where, value, rule));
  }
}

int exit_code_of(const std::vector<thermal::ConvertOutcome>& outcomes, double max_unusable_share) {
  const auto is_faulty = [=](const auto& outcome) { return has_faults(outcome, max_unusable_share); };
  if (std::none_of(outcomes.begin(), outcomes.end(), is_faulty)) return kDone;
  return std::any_of(outcomes.begin(), outcomes.end(), has_clips) ? kSomeRejected : kFailed;
}

}  // namespace

void print_left_over(const std::vector<thermal::LeftOver>& left_over) {
  for (const auto& [place, reason] : left_over)
    print_error("veldt: warning: cannot remove {}: {}; the next run tries again\n", place.string(), reason);
}

void add_max_unusable(Command& command, double& max_unusable_share) {
  command
      .add_option(
          "--max-unusable-share", max_unusable_share,
          "Exit 3 if a larger share of a clip's pixels has no usable depth or normal where a kept term "
          "needs one: NaN, infinite, depth of 0 or less, a normal of length 0. Smaller ones are warned of")
      .type_name("FRACTION")
      .shows_default();
}

void check_max_unusable(double max_unusable_share) {
  if (max_unusable_share >= 0 && max_unusable_share <= 1) return;
  throw thermal::ConfigError(
      thermal::fault("--max-unusable-share", fmt::format("{}", max_unusable_share), "", "from 0 to 1"));
}

int summarise(const thermal::RunOutcome& outcome, const thermal::Path& out, const CommonOptions& options,
              const std::string& done, double max_unusable_share) {
  print_failed(outcome, "", "failed");
  print_unusable(outcome, "", max_unusable_share);
  print_left_over(outcome.left_over);
  if (!options.quiet) print("{}: {}\n", out.string(), summary_of(outcome, done, 0));
  if (outcome.try_again) return kTryAgain;
  return exit_code_of({{.variant = "", .out = out, .run = outcome, .skips = {}}}, max_unusable_share);
}

int summarise(const std::vector<thermal::ConvertOutcome>& outcomes, const CommonOptions& options,
              double max_unusable_share) {
  for (const thermal::ConvertOutcome& one : outcomes) {
    const std::string whose = one.variant.empty() ? "" : one.variant + ": ";
    print_failed(one.run, whose, "rejected");
    print_unusable(one.run, whose, max_unusable_share);
    print_left_over(one.run.left_over);
  }
  for (const std::string& line : skip_lines(outcomes)) print_error("veldt: {}\n", line);
  for (const thermal::ConvertOutcome& one : outcomes) {
    if (options.quiet) break;
    const std::string out = one.out.string();
    print("{}: {}\n", out, summary_of(one.run, "made", frames_in(one.skips)));
    for (const std::string& term : one.left_out) print("{}: without the term {}\n", out, term);
  }
  return exit_code_of(outcomes, max_unusable_share);
}

}  // namespace veldt
