#include "dataset/run/monitor.h"

#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "dataset/run/disk_space.h"

namespace thermal {

RunMonitor::RunMonitor(const RunHooks& hooks, const Path& out, int frames_total) : hooks_(hooks), out_(out) {
  progress_.total = frames_total;
}

void RunMonitor::begin(const ClipConfig& clip) {
  const std::lock_guard lock(mutex_);
  frames_done_[clip.id] = 0;
  progress_.clip = clip.id;
  hooks_.report(progress_);
}

void RunMonitor::frame_done(const std::string& clip) {
  const std::lock_guard lock(mutex_);
  ++frames_done_[clip];
  ++progress_.done;
  progress_.clip = clip;
  hooks_.report(progress_);
}

void RunMonitor::made(const ClipConfig& clip) {
  const std::lock_guard lock(mutex_);
  outcome_.made.push_back(clip.id);
  outcome_.frames_made += clip.frames;
  end(clip);
}

void RunMonitor::lost(const ClipConfig& clip, const std::string& why, bool killed) {
  const std::lock_guard lock(mutex_);
  outcome_.failed[clip.id] = why;
  all_killed_ = all_killed_ && killed;
  progress_.done += clip.frames - frames_done_[clip.id];  // those will never come
  end(clip);
  hooks_.report(progress_);
}

void RunMonitor::end(const ClipConfig& clip) {
  frames_done_.erase(clip.id);
  needs_.erase(clip.id);
}

void RunMonitor::restarted(const std::string& clip, const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (hooks_.restarted) hooks_.restarted(clip, why);
}

void RunMonitor::needs(const std::string& clip, std::int64_t bytes) {
  const std::lock_guard lock(mutex_);
  needs_[clip] = bytes;
  std::int64_t all_bytes = 0;
  std::vector<std::string> clips;
  for (const auto& [id, needed_bytes] : needs_) {
    all_bytes += needed_bytes;
    clips.push_back(id);
  }
  const std::string whose = fmt::format("{} {}", clips.size() == 1 ? "clip" : "clips", list_names(clips));
  check_space(free_bytes(out_), all_bytes, out_.string(), whose);
}

bool RunMonitor::stop_wanted() {
  const std::lock_guard lock(mutex_);
  return hooks_.stop_wanted();
}

RunOutcome RunMonitor::outcome() {
  const std::lock_guard lock(mutex_);
  RunOutcome outcome = outcome_;
  outcome.try_again = outcome.made.empty() && !outcome.failed.empty() && all_killed_;
  return outcome;
}

}  // namespace thermal
