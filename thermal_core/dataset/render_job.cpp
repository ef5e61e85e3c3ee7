#include "dataset/render_job.h"

#include <algorithm>
#include <chrono>
#include <sstream>

#include <fmt/format.h>

#include "io/json_file.h"

namespace thermal {
namespace {

constexpr int kPollMs = 100;

/// The line of Blender's output that says most about a failure: the last one that names an error.
std::string telling_line(const Path& log) {
  std::string telling;
  std::istringstream lines(read_file(log));
  for (std::string line; std::getline(lines, line);) {
    if (line.find("Error") != std::string::npos || line.find("error") != std::string::npos) telling = line;
  }
  return telling;
}

std::deque<std::string> clips_of(const RenderJob::Task& task) {
  if (task.preview) return {RenderJob::kPreview};
  return {task.clips.begin(), task.clips.end()};
}

}  // namespace

std::vector<std::string> render_command(const RenderJob::Task& task) {
  std::vector<std::string> command = {task.blender.string(), "--background", "--factory-startup",
                                      "--python-exit-code", "1"};
  if (task.threads > 0) command.insert(command.end(), {"--threads", std::to_string(task.threads)});
  const std::string script = (task.home / "blender_scripts" / "render_passes.py").string();
  command.insert(command.end(),
                 {"--python", script, "--", "--config", task.config.string(), "--out", task.passes.string(),
                  "--events-fd", std::to_string(ChildProcess::kEventDescriptor)});
  for (const std::string& clip : task.clips) command.insert(command.end(), {"--clip", clip});
  if (task.preview) command.emplace_back("--preview");
  return command;
}

RenderJob::RenderJob(const Task& task)
    : task_(task), left_(clips_of(task)), runner_([this](const std::stop_token& stop) { run(stop); }) {}

RenderJob::~RenderJob() {
  runner_.request_stop();
  runner_.join();
}

void RenderJob::run(const std::stop_token& stop) {
  try {
    while (run_once(stop)) {
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    fault_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

/// One Blender from start to end. Returns whether another is to go on.
bool RenderJob::run_once(const std::stop_token& stop) {
  ChildProcess process(render_command(task_left()), task_.log);
  while (!stop.stop_requested() && !process.ended()) {
    if (const auto line = process.next_line(kPollMs)) take_event(*line);
  }
  if (!stop.stop_requested()) return take_end(process.wait());
  process.stop();
  return false;
}

RenderJob::Task RenderJob::task_left() {
  const std::lock_guard lock(mutex_);
  run_ = {};
  Task task = task_;
  if (!task.preview) task.clips.assign(left_.begin(), left_.end());
  return task;
}

void RenderJob::take_event(const std::string& line) {
  const Json event = Json::parse(line, nullptr, false);
  if (event.is_discarded() || !event.contains("event")) return;
  const std::lock_guard lock(mutex_);
  const auto kind = event["event"].get<std::string>();
  if (kind == "scene_built") {
    run_.scene_built = true;
    if (!left_.empty()) run_.doing = "rendering clip " + left_.front();
  } else if (kind == "clip") {
    ready_[event["clip"]] = 1 + event["first_frame"].get<int>();
    frames_[event["clip"]] = event.value("frames", 0);
    run_.doing = fmt::format("rendering clip {}", event["clip"].get<std::string>());
    leave_if_whole(event["clip"]);
  } else if (kind == "frame") {
    const int index = event["index"];
    ready_[event["clip"]] = 2 + index;
    run_.doing = fmt::format("rendering clip {} after frame {}", event["clip"].get<std::string>(), index);
    leave_if_whole(event["clip"]);
  } else if (kind == "error") {
    if (event.value("kind", "") == "config") run_.blame = Blame::config;
    const auto where = event.value("where", std::string());
    run_.failure =
        event.value("message", std::string("unknown reason")) + (where.empty() ? "" : " (" + where + ")");
  }
  changed_.notify_all();
}

/// Another Blender is not to render again what may be converted and gone by then.
void RenderJob::leave_if_whole(const std::string& clip) {
  const int frames = frames_[clip];  // 0 where Blender did not tell
  if (frames == 0 || ready_[clip] <= frames || left_.empty() || left_.front() != clip) return;
  left_.pop_front();
  deaths_in_clip_ = 0;
}

/// Returns whether another Blender is to go on. Throws what ends the job.
bool RenderJob::take_end(const ExitStatus& status) {
  std::unique_lock lock(mutex_);
  if (left_.empty()) return false;  // however it ended: all is there
  explain(status);
  if (is_disk_full(task_.passes) || run_.blame == Blame::config) throw_failure();
  const std::string clip = left_.front();
  if (may_try_again()) {
    const std::string why = run_.failure;
    lock.unlock();
    if (task_.restarted) task_.restarted(clip, why);
    return true;
  }
  if (task_.preview || !run_.scene_built) throw_failure();
  lost_.emplace(clip, ClipLost(run_.failure, run_.blame == Blame::circumstances));
  left_.pop_front();
  deaths_in_clip_ = 0;
  changed_.notify_all();
  return !left_.empty();
}

/// Puts into words why Blender ended early, unless it did so itself.
void RenderJob::explain(const ExitStatus& status) {
  if (!run_.failure.empty()) return;
  if (status.signal != 0) {
    run_.blame = Blame::circumstances;
    run_.failure =
        fmt::format("Blender {} while {}; if nobody stopped it, the machine may have run out of memory",
                    status.in_words(), run_.doing);
  } else if (status.code != 0) {
    const std::string said = telling_line(task_.log);
    run_.failure = fmt::format("Blender {} while {}{}", status.in_words(), run_.doing,
                               said.empty() ? "; it gave no reason" : ": " + said);
  } else {
    run_.failure = fmt::format("Blender ended early while {}", run_.doing);
  }
}

/// Counts a death.
bool RenderJob::may_try_again() {
  constexpr int kDeathsTooMany = 2;
  if (!run_.scene_built) return ++deaths_in_scene_ < kDeathsTooMany;
  deaths_in_scene_ = 0;
  return ++deaths_in_clip_ < kDeathsTooMany;
}

void RenderJob::throw_failure() const {
  if (is_disk_full(task_.passes)) throw TryAgainError(run_.failure + "; the disk is full");
  if (run_.blame == Blame::config) throw ConfigError(run_.failure);
  if (run_.blame == Blame::circumstances) throw TryAgainError(run_.failure);
  throw IoError(run_.failure);
}

void RenderJob::wait_until(const std::function<bool()>& done, const std::function<bool()>& cancelled,
                           const std::string& clip) {
  std::unique_lock lock(mutex_);
  while (!done()) {
    if (const auto lost = lost_.find(clip); lost != lost_.end()) throw ClipLost(lost->second);
    if (fault_) std::rethrow_exception(fault_);
    if (ended_) throw IoError(fmt::format("Blender ended early while {}", run_.doing));
    if (cancelled && cancelled()) throw Cancelled();
    changed_.wait_for(lock, std::chrono::milliseconds(kPollMs));
  }
}

void RenderJob::wait_for_frame(const std::string& clip, int frame, const std::function<bool()>& cancelled) {
  wait_until([&] { return ready_[clip] > frame + 1; }, cancelled, clip);
}

int RenderJob::frames_of(const std::string& clip) {
  const std::lock_guard lock(mutex_);
  return frames_[clip];
}

int RenderJob::frames_ready(const std::string& clip) {
  const std::lock_guard lock(mutex_);
  return std::max(0, ready_[clip] - 1);
}

void RenderJob::wait_for_end(const std::function<bool()>& cancelled) {
  wait_until([&] { return ended_; }, cancelled, "");
  rethrow_fault();
}

void RenderJob::rethrow_fault() {
  const std::lock_guard lock(mutex_);
  if (fault_) std::rethrow_exception(fault_);
}

}  // namespace thermal
