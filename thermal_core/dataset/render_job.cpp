#include "dataset/render_job.h"

#include <chrono>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
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
    : task_(task),
      process_(render_command(task), task.log),
      listener_([this](const std::stop_token& stop) { listen(stop); }) {}

RenderJob::~RenderJob() {
  listener_.request_stop();
  listener_.join();
}

void RenderJob::listen(const std::stop_token& stop) {
  while (!stop.stop_requested() && !process_.ended()) {
    if (const auto line = process_.next_line(kPollMs)) take_event(*line);
  }
  if (stop.stop_requested()) {
    process_.stop();
    return;
  }
  take_end(process_.wait());
}

void RenderJob::take_event(const std::string& line) {
  const Json event = Json::parse(line, nullptr, false);
  if (event.is_discarded() || !event.contains("event")) return;
  const std::lock_guard lock(mutex_);
  const auto kind = event["event"].get<std::string>();
  if (kind == "clip") {
    ready_[event["clip"]] = 1 + event["first_frame"].get<int>();
    frames_[event["clip"]] = event.value("frames", 0);
    doing_ = fmt::format("rendering clip {}", event["clip"].get<std::string>());
  } else if (kind == "frame") {
    const int index = event["index"];
    ready_[event["clip"]] = 2 + index;
    doing_ = fmt::format("rendering clip {} after frame {}", event["clip"].get<std::string>(), index);
  } else if (kind == "error") {
    if (event.value("kind", "") == "config") blame_ = Blame::config;
    const auto where = event.value("where", std::string());
    failure_ =
        event.value("message", std::string("unknown reason")) + (where.empty() ? "" : " (" + where + ")");
  }
  changed_.notify_all();
}

void RenderJob::take_end(const ExitStatus& status) {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  if (failure_.empty() && status.signal != 0) {
    blame_ = Blame::circumstances;
    failure_ =
        fmt::format("Blender {} while {}; if nobody stopped it, the machine may have run out of memory",
                    status.in_words(), doing_);
  } else if (failure_.empty() && status.code != 0) {
    const std::string said = telling_line(task_.log);
    failure_ = fmt::format("Blender {} while {}{}", status.in_words(), doing_,
                           said.empty() ? "; it gave no reason" : ": " + said);
  }
  changed_.notify_all();
}

void RenderJob::throw_failure() const {
  if (failure_.empty()) throw IoError(fmt::format("Blender ended early while {}", doing_));
  if (is_disk_full(task_.passes)) throw TryAgainError(failure_ + "; the disk is full");
  if (blame_ == Blame::config) throw ConfigError(failure_);
  if (blame_ == Blame::circumstances) throw TryAgainError(failure_);
  throw IoError(failure_);
}

void RenderJob::wait_until(const std::function<bool()>& done, const std::function<bool()>& cancelled) {
  std::unique_lock lock(mutex_);
  while (!done()) {
    if (ended_) throw_failure();
    if (cancelled && cancelled()) throw Cancelled();
    changed_.wait_for(lock, std::chrono::milliseconds(kPollMs));
  }
}

void RenderJob::wait_for_frame(const std::string& clip, int frame, const std::function<bool()>& cancelled) {
  wait_until([&] { return ready_[clip] > frame + 1; }, cancelled);
}

int RenderJob::frames_of(const std::string& clip) {
  const std::lock_guard lock(mutex_);
  return frames_[clip];
}

void RenderJob::wait_for_end(const std::function<bool()>& cancelled) {
  wait_until([&] { return ended_; }, cancelled);
  const std::lock_guard lock(mutex_);
  if (!failure_.empty()) throw_failure();
}

}  // namespace thermal
