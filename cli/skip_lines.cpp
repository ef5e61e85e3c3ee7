#include "cli/skip_lines.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/printable.h"

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

}  // namespace

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

}  // namespace veldt
