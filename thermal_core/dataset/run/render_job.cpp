#include "dataset/run/render_job.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "base/parallel.h"
#include "base/text.h"

namespace thermal {
namespace {

constexpr std::uintmax_t kMostReadBytes = 65536;
constexpr std::size_t kMostLines = 3;
constexpr std::size_t kLongestLineBytes = 200;

std::string tail_of(const Path& log, std::uintmax_t from) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(log, none);
  if (none || size <= from) return "";
  std::ifstream file(log, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(size - std::min(size - from, kMostReadBytes)));
  return {std::istreambuf_iterator<char>(file), {}};
}

bool says_something(std::string_view line) {
  return line.find_first_not_of(" \t\r") != std::string_view::npos && line != "Blender quit";
}

}  // namespace

std::string ReportedFailure::in_words() const {
  return message + (where.empty() ? "" : " (" + where + ")") + (hint.empty() ? "" : "; " + hint);
}

ReportedFailure reported_failure(const Json& event) {
  const auto text = [&event](const char* field, const char* otherwise) {
    return printable(event.value(field, std::string(otherwise)));
  };
  return {.message = text("message", "unknown reason"),
          .where = text("where", ""),
          .hint = text("hint", ""),
          .config = text("kind", "") == "config"};
}

std::string last_error_line_in(const Path& log, std::uintmax_t from) {
  const std::string tail = tail_of(log, from);
  std::vector<std::string> last;
  for (const std::string_view line : split(tail, '\n')) {
    if (says_something(line)) last.push_back(printable(line.substr(0, kLongestLineBytes)));
  }
  const std::size_t left_out = last.size() - std::min(last.size(), kMostLines);
  return fmt::format("{}",
                     fmt::join(last.begin() + static_cast<std::ptrdiff_t>(left_out), last.end(), " / "));
}

std::string unreported_end(const ExitStatus& status, const std::string& doing,
                           const std::string& last_error_line) {
  const std::string how = status.signal == 0 && status.code == 0 ? "ended early" : status.in_words();
  std::string end = fmt::format("Blender {} while {}", how, doing);
  if (status.signal == SIGKILL) return fmt::format("{}; {}", end, kKilledHint);
  if (status.is_killed()) return end;
  return end + (last_error_line.empty() ? "; it printed nothing" : ": " + last_error_line);
}

namespace {

constexpr int kPollMs = 100;

std::string with_log(const std::string& failure, const Path& log) {
  return failure + "; log: " + log.string();
}

std::uintmax_t size_of(const Path& log) {
  std::error_code none;
  const std::uintmax_t bytes = std::filesystem::file_size(log, none);
  return none ? 0 : bytes;
}

std::deque<std::string> clips_of(const RenderJob::Task& task) {
  if (task.preview) return {RenderJob::kPreview};
  return {task.clips.begin(), task.clips.end()};
}

}  // namespace

std::vector<std::string> render_command(const RenderJob::Task& task) {
  std::vector<std::string> command = {task.blender.string(), "--background",       "--factory-startup",
                                      "--disable-autoexec",  "--python-exit-code", "1"};
  if (task.threads > 0) command.insert(command.end(), {"--threads", std::to_string(task.threads)});
  const std::string script = (task.assets.script("render_passes.py")).string();
  command.insert(command.end(),
                 {"--python", script, "--", "--plan", task.plan.string(), "--out", task.passes.string(),
                  "--events-fd", std::to_string(ChildProcess::kEventDescriptor)});
  for (const std::string& clip : task.clips) command.insert(command.end(), {"--clip", clip});
  if (task.preview) {
    command.emplace_back("--preview");
    return command;
  }
  command.insert(command.end(), {"--supersample", std::to_string(task.supersample)});
  if (task.actor_layer) command.emplace_back("--actor-layer");
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
    std::error_code none;
    std::filesystem::remove(task_.log, none);  // an earlier run's
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
    if (const auto line = process.next_line(kPollMs)) take_line(*line);
  }
  if (!stop.stop_requested()) return take_end(process.wait());
  process.stop();
  return false;
}

RenderJob::Task RenderJob::task_left() {
  const std::lock_guard lock(mutex_);
  run_ = {};
  run_.log_begin = size_of(task_.log);
  Task task = task_;
  if (!task.preview) task.clips.assign(left_.begin(), left_.end());
  return task;
}

void RenderJob::take_line(const std::string& line) {
  constexpr std::size_t kMostShownBytes = 200;
  const Json event = Json::parse(line, nullptr, false);
  if (!event.is_object() || !event.contains("event")) return;
  const std::lock_guard lock(mutex_);
  try {
    take_event(event);
  } catch (const Json::exception&) {
    const std::string shown = printable(line.substr(0, kMostShownBytes));
    throw IoError(
        with_log(fmt::format("Blender sent a malformed event while {}: {}", run_.doing, shown), task_.log));
  }
}

void RenderJob::take_event(const Json& event) {
  const auto kind = event.at("event").get<std::string>();
  if (kind == "scene_built") {
    run_.scene_built = true;
    if (!left_.empty()) run_.doing = "rendering clip " + left_.front();
  } else if (kind == "clip") {
    ready_[event.at("clip")] = event.at("first_frame").get<int>();
    frames_[event.at("clip")] = event.value("frames", 0);
    run_.doing = fmt::format("rendering clip {}", event.at("clip").get<std::string>());
    leave_if_whole(event.at("clip"));
  } else if (kind == "frame") {
    const int index = event.at("index");
    ready_[event.at("clip")] = 1 + index;
    run_.doing = fmt::format("rendering clip {} after frame {}", event.at("clip").get<std::string>(), index);
    leave_if_whole(event.at("clip"));
  } else if (kind == "error") {
    const ReportedFailure failure = reported_failure(event);
    if (failure.config) run_.cause = FailureCause::config;
    run_.failure =
        failure.config
            ? failure.message
            : with_log(fmt::format("Blender failed while {}: {}", run_.doing, failure.in_words()), task_.log);
  }
  changed_.notify_all();
}

/// Another Blender is not to render again what may be converted and gone by then.
void RenderJob::leave_if_whole(const std::string& clip) {
  const int frames = frames_[clip];  // 0 if Blender did not report it
  if (frames == 0 || ready_[clip] < frames || left_.empty() || left_.front() != clip) return;
  left_.pop_front();
  deaths_in_clip_ = 0;
}

/// Returns whether another Blender is to go on. Throws what ends the job.
bool RenderJob::take_end(const ExitStatus& status) {
  std::unique_lock lock(mutex_);
  if (left_.empty()) return false;  // however it ended: all is there
  explain(status);
  if (is_disk_full(task_.passes) || run_.cause == FailureCause::config) throw_failure();
  const std::string clip = left_.front();
  if (may_try_again()) {
    const std::string why = run_.failure;
    lock.unlock();
    if (task_.restarted) task_.restarted(clip, why);
    return true;
  }
  if (task_.preview || !run_.scene_built) throw_failure();
  lost_.emplace(clip, ClipLost(run_.failure, run_.cause == FailureCause::circumstances));
  left_.pop_front();
  deaths_in_clip_ = 0;
  changed_.notify_all();
  return !left_.empty();
}

/// Puts into words why Blender ended early, unless it did so itself.
void RenderJob::explain(const ExitStatus& status) {
  if (!run_.failure.empty()) return;
  if (status.signal != 0) run_.cause = FailureCause::circumstances;
  const std::string last_error_line = last_error_line_in(task_.log, run_.log_begin);
  run_.failure = with_log(unreported_end(status, run_.doing, last_error_line), task_.log);
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
  if (run_.cause == FailureCause::config) throw ConfigError(run_.failure);
  if (run_.cause == FailureCause::circumstances) throw TryAgainError(run_.failure);
  throw IoError(run_.failure);
}

void RenderJob::wait_until(const std::function<bool()>& done, const std::function<bool()>& cancelled,
                           const std::string& clip) {
  std::unique_lock lock(mutex_);
  while (!done()) {
    if (const auto lost = lost_.find(clip); lost != lost_.end()) throw ClipLost(lost->second);
    if (fault_) std::rethrow_exception(fault_);
    if (ended_) throw IoError(with_log(fmt::format("Blender ended early while {}", run_.doing), task_.log));
    if (cancelled && cancelled()) throw Cancelled();
    changed_.wait_for(lock, std::chrono::milliseconds(kPollMs));
  }
}

void RenderJob::wait_for_frame(const std::string& clip, int frame, const std::function<bool()>& cancelled) {
  wait_until([&] { return ready_[clip] > frame; }, cancelled, clip);
}

int RenderJob::wait_for_count(const std::string& clip, const std::function<bool()>& cancelled) {
  wait_until([&] { return frames_.contains(clip); }, cancelled, clip);
  const std::lock_guard lock(mutex_);
  return frames_[clip];
}

int RenderJob::frames_ready(const std::string& clip) {
  const std::lock_guard lock(mutex_);
  return ready_[clip];
}

void RenderJob::wait_for_end(const std::function<bool()>& cancelled) {
  wait_until([&] { return ended_; }, cancelled, "");
  rethrow_fault();
}

void RenderJob::rethrow_fault() {
  const std::lock_guard lock(mutex_);
  if (fault_) std::rethrow_exception(fault_);
}

namespace {

/// Threads that all stop when the first of them throws.
class WorkerPool {
 public:
  WorkerPool(const ClipWork& work, const std::function<bool()>& cancelled)
      : work_(work), stop_wanted_([this, &cancelled] { return failed_ || (cancelled && cancelled()); }) {}

  void run(const std::vector<RenderJob::Task>& tasks) {
    {
      std::vector<std::jthread> threads;
      for (const RenderJob::Task& task : tasks) threads.emplace_back([this, &task] { run_guarded(task); });
    }
    if (first_fault_) std::rethrow_exception(first_fault_);
  }

 private:
  void run_guarded(const RenderJob::Task& task) noexcept {
    try {
      RenderJob job(task);
      for (const std::string& clip : task.clips) work_(clip, job, stop_wanted_);
      job.wait_for_end(stop_wanted_);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_fault_) first_fault_ = std::current_exception();
      failed_ = true;
    }
  }

  const ClipWork& work_;
  std::function<bool()> stop_wanted_;
  std::mutex mutex_;
  std::exception_ptr first_fault_;
  std::atomic<bool> failed_ = false;
};

}  // namespace

std::vector<std::vector<std::string>> deal_clips(const std::vector<std::string>& clips, int jobs) {
  const std::size_t hands = std::min(static_cast<std::size_t>(jobs), clips.size());
  std::vector<std::vector<std::string>> dealt(hands);
  for (std::size_t i = 0; i < clips.size(); ++i) dealt[i % hands].push_back(clips[i]);
  return dealt;
}

int threads_each(int threads, int jobs) { return std::max(1, threads / jobs); }

void run_workers(const std::vector<RenderJob::Task>& tasks, int threads, const ClipWork& work,
                 const std::function<bool()>& cancelled) {
  const int share = threads == 0 ? thread_count(0) : threads_each(threads, static_cast<int>(tasks.size()));
  const ClipWork limited = [&](const std::string& clip, RenderJob& job, const std::function<bool()>& stop) {
    with_threads(share, [&] { work(clip, job, stop); });
  };
  WorkerPool(limited, cancelled).run(tasks);
}

}  // namespace thermal
