#include "bench/blender_profile.h"

#include <algorithm>
#include <chrono>
#include <functional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/run/blender_failure.h"
#include "io/json/file.h"
#include "io/system/child_process.h"

namespace thermal {
namespace {

std::vector<std::string> command_of(const ProfileTask& task, const char* script) {
  std::vector<std::string> command = {task.blender.string(), "--background",       "--factory-startup",
                                      "--disable-autoexec",  "--python-exit-code", "1"};
  command.insert(command.end(), {"--threads", std::to_string(thread_count(task.threads))});
  command.insert(command.end(),
                 {"--python", (task.assets.script(script)).string(), "--", "--plan", task.plan.string(),
                  "--out", task.out.string(), "--events-fd", std::to_string(ChildProcess::kEventDescriptor)});
  return command;
}

/// Runs Blender to completion. IoError with Blender's reason if it fails.
void run_blender(const std::vector<std::string>& command, const ProfileTask& task,
                 const std::function<void(const std::string& kind, const Json& event)>& take) {
  constexpr int kPollMs = 1000;
  Path log = task.out;
  log += ".log";
  ChildProcess process(command, log);
  std::string reported;
  while (!process.ended()) {
    const Json event = Json::parse(process.next_line(kPollMs).value_or(""), nullptr, false);
    if (!event.is_object()) continue;
    const auto kind = event.value("event", std::string());
    if (kind == "error") reported = reported_failure(event).in_words();
    take(kind, event);
  }
  const ExitStatus status = process.wait();
  if (status.signal == 0 && status.code == 0) return;
  // The log's folder will be removed, so its last line is part of the message.
  throw IoError(reported.empty() ? unreported_end(status, "measuring frames", last_error_line_in(log, 0))
                                 : "Blender failed while measuring frames: " + reported);
}

Profile to_profile(const Json& event) {
  Profile profile{.pixels = event.at("pixels"),
                  .objects = event.at("objects"),
                  .frame_s = event.at("frame_s"),
                  .split_s = {},
                  .peak_mb = event.at("peak_mb")};
  for (const std::string& step : frame_steps()) profile.split_s[step] = event.at("split_s").at(step);
  return profile;
}

}  // namespace

const std::vector<std::string>& frame_steps() {
  static const std::vector<std::string> kSteps = {"pose", "scene", "sync_and_trees", "trace", "write"};
  return kSteps;
}

std::vector<Profile> profile_frames(const ProfileTask& task, const ProfileFrames& frames) {
  std::vector<std::string> command = command_of(task, "profile_render.py");
  command.insert(command.end(), {"--frames", std::to_string(frames.frames), "--supersample"});
  for (const int supersample : frames.supersamples) command.push_back(std::to_string(supersample));
  if (!frames.clips.empty()) command.emplace_back("--clip");
  command.insert(command.end(), frames.clips.begin(), frames.clips.end());
  std::vector<Json> events;
  run_blender(command, task, [&events](const std::string& kind, const Json& event) {
    if (kind == "profile") events.push_back(event);
  });
  const std::size_t expected = frames.supersamples.size() * std::max(frames.clips.size(), std::size_t{1});
  if (events.size() != expected)
    throw IoError(
        fmt::format("profile_render.py reported {} profiles instead of {}", events.size(), expected));
  try {
    std::vector<Profile> profiles;
    for (const Json& event : events) profiles.push_back(to_profile(event));
    return profiles;
  } catch (const Json::exception& error) {
    throw IoError(fmt::format("unexpected output of profile_render.py: {}", error.what()));
  }
}

double rendered_per_s(const ProfileTask& task, const std::string& clip) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::string> command = command_of(task, "render_passes.py");
  command.insert(command.end(), {"--clip", clip, "--actor-layer"});
  std::vector<Clock::time_point> whole_at;
  run_blender(command, task, [&whole_at](const std::string& kind, const Json&) {
    if (kind == "frame") whole_at.push_back(Clock::now());
  });
  if (whole_at.size() < 2) throw IoError("render_passes.py reported fewer than two frames");
  const std::chrono::duration<double> taken = whole_at.back() - whole_at.front();
  return static_cast<double>(whole_at.size() - 1) / taken.count();
}

}  // namespace thermal
