#include "bench/render_suite.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "bench/measure.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/render_job.h"
#include "io/exr/passes.h"
#include "io/json/file.h"
#include "io/system/child_process.h"
#include "io/system/temporary.h"

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

namespace {

/// Plans a config of the project into a folder.
Path plan_of_config(const Assets& assets, const std::string& name, Path folder) {
  const Path file = assets.config(name);
  PlanStore(folder, assets)
      .plan(resolve_config(read_json(file), file.string(), assets), file.string(), {.assets = assets});
  return folder;
}

RenderRow scene_row(const std::string& scene, int supersample, const Profile& profile) {
  RenderRow row{"frame, s", fmt::format("{} {}x{}", scene, supersample, supersample), {}};
  row.figures = {{"pixels", profile.pixels}, {"objects", profile.objects}, {"frame", profile.frame_s}};
  for (const std::string& step : frame_steps()) row.figures.push_back({step, profile.split_s.at(step)});
  return row;
}

Passes read_all(const Path& file) {
  return read_passes(file, {.layer = "Scene"}, {.depth = true, .normals = true});
}

/// Time and size of files. Blender's time to write a file is among the steps of a frame.
std::vector<RenderRow> file_rows(const Path& file) {
  constexpr double kMega = 1e6;
  const std::string content = read_file(file);
  const double file_mb = static_cast<double>(content.size()) / kMega;
  Path copy = file;
  copy += ".copy";
  const auto bytes = std::as_bytes(std::span(content));
  const auto row = [&](const std::string& name, double seconds) {
    return RenderRow{"file of passes", name, {{"ms", 1e3 * seconds}, {"mb", file_mb}}};
  };
  return {row("the converter reads it", shortest_run_s([&] { (void)read_all(file); })),
          row("its bytes copied", memcpy_s(content.size())), row("its bytes written", shortest_run_s([&] {
                                                                   std::filesystem::remove(copy);
                                                                   write_file(copy, bytes);
                                                                 }))};
}

/// Pixels with any bit different in any plane.
int differing_pixels(const Passes& one, const Passes& other) {
  int count = 0;
  const auto differs = [](const auto& a, const auto& b, std::size_t at) {
    return !a.empty() && (a.size() != b.size() || a.pixels()[at] != b.pixels()[at]);
  };
  for (std::size_t at = 0; at < one.object_index.size(); ++at) {
    bool any = differs(one.object_index, other.object_index, at);
    any |= differs(one.material_index, other.material_index, at) || differs(one.depth_m, other.depth_m, at);
    for (std::size_t axis = 0; axis < 3; ++axis)
      any |= differs(one.normal.at(axis), other.normal.at(axis), at);
    count += any ? 1 : 0;
  }
  return count;
}

RenderRow process_row(const char* name, double frames_per_s, int differing_px) {
  return {"demo with actor layers",
          name,
          {{"frames_per_s", frames_per_s}, {"differing_px", static_cast<double>(differing_px)}}};
}

/// Frames/s of one process with two threads and of two with one each, with actor layers; then a frame as a file.
std::vector<RenderRow> process_rows(const RenderSuiteTask& task, const Path& folder) {
  constexpr int kFrames = 12;
  Json document = read_json(task.assets.config("demo"));
  document["clips"][0]["frames"] = kFrames;
  const std::string clip = document["clips"][0]["id"];
  const Path plan = folder / "layers";
  PlanStore(plan, task.assets)
      .plan(resolve_config(std::move(document), "demo", task.assets), "demo", {.assets = task.assets});
  const auto rate = [&](const char* out, int threads) {
    return rendered_per_s({task.blender, task.assets, plan, folder / out, threads}, clip);
  };
  const auto frame = [&](const char* out) { return folder / out / clip / "000001.exr"; };
  task.announce("demo with actor layers, one process of two threads");
  const double wide = rate("wide", 2);
  task.announce("demo with actor layers, two processes of one thread");
  auto second = std::async(std::launch::async, [&] { return rate("second", 1); });
  const double first = rate("first", 1);
  const double pair = first + second.get();
  const int differing = differing_pixels(read_all(frame("wide")), read_all(frame("first")));
  std::vector<RenderRow> rows = {process_row("one process of two threads", wide, 0),
                                 process_row("two processes of one thread", pair, differing)};
  for (const RenderRow& row : file_rows(frame("wide"))) rows.push_back(row);
  return rows;
}

}  // namespace

std::vector<RenderRow> run_render_suite(const RenderSuiteTask& task) {
  const TemporaryFolder folder;
  std::vector<RenderRow> rows;
  for (const char* scene : {"demo", "savanna"}) {
    task.announce(fmt::format("{}, planning", scene));
    const Path plan = plan_of_config(task.assets, scene, folder.path() / scene);
    for (const int supersample : {1, 2}) {
      task.announce(fmt::format("{}, {}x{} rays per pixel", scene, supersample, supersample));
      const Path out = folder.path() / fmt::format("{}_{}", scene, supersample);
      const ProfileTask frames = {.blender = task.blender, .assets = task.assets, .plan = plan, .out = out};
      const std::vector<Profile> profiles = profile_frames(frames, {.supersamples = {supersample}});
      rows.push_back(scene_row(scene, supersample, profiles.front()));
    }
  }
  for (const RenderRow& row : process_rows(task, folder.path())) rows.push_back(row);
  return rows;
}

}  // namespace thermal
