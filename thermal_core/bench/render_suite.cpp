#include "bench/render_suite.h"

#include <future>
#include <span>

#include <fmt/format.h>

#include "bench/blender_profile.h"
#include "bench/measure.h"
#include "dataset/plan/planning.h"
#include "io/assets.h"
#include "io/exr/passes.h"
#include "io/json/file.h"
#include "io/system/temporary_folder.h"

namespace thermal {
namespace {

/// Plans a config of the project into a folder.
Path plan_of_config(const Assets& assets, const std::string& name, Path folder) {
  const Path file = assets.config(name);
  (void)plan_into(folder, resolve_config(read_json(file), file.string(), assets), file.string(),
                  {.assets = assets});
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
  (void)plan_into(plan, resolve_config(std::move(document), "demo", task.assets), "demo",
                  {.assets = task.assets});
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
