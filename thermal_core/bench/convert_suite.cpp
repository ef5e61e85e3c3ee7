#include "bench/convert_suite.h"

#include <fmt/format.h>

#include "bench/convert_stages.h"
#include "bench/convert_whole.h"
#include "bench/passes_file.h"
#include "bench/sensor_scene.h"
#include "io/passing_folder.h"

namespace thermal {
namespace {

ClipTask task_of(const BenchScene& scene) {
  ClipTask task;
  task.clip = {.id = scene.manifest.clip, .season = Season::winter, .frames = 1, .frame_rate_hz = 9};
  return task;
}

/// Every term that reads planes, and a camera with every stage.
ClipTask physical_task_of(const BenchScene& scene) {
  ClipTask task = task_of(scene);
  task.sensor = full_camera();
  const Terms terms = {
      .variation = true, .parts = true, .sky = true, .angular = true, .path = true, .falloff = false};
  task.physics = PhysicsSettings{
      .terms = terms, .weather = weather_of(Season::winter), .response = task.sensor.response, .seed = 1};
  return task;
}

/// Clips to convert end to end.
struct Whole {
  int frames = 0;
  std::vector<int> threads;  ///< 0: one per processor
};

void add_rows(const BenchScene& scene, const MaterialLibrary& materials, const Whole& work,
              const std::function<void(const std::string&)>& announce, std::vector<ConvertRow>& rows) {
  const std::string size =
      fmt::format("{} x {}", scene.manifest.camera.width_px, scene.manifest.camera.height_px);
  const PassingFolder folder;
  const ConvertJob job{.scene = scene,
                       .file = folder.path() / "000000.exr",
                       .materials = materials,
                       .published = task_of(scene),
                       .physical = physical_task_of(scene)};
  write_passes(job.file, scene.passes);
  announce(size + ", stages");
  const std::vector<ConvertRow> stages = convert_stage_rows(job, folder.path());
  rows.insert(rows.end(), stages.begin(), stages.end());
  for (const bool physical : {false, true}) {
    for (const int threads : work.threads) {
      announce(fmt::format("{}, clips by the {} model, {}", size, physical ? "physical" : "published",
                           threads == 1 ? "one thread" : "all threads"));
      rows.push_back(convert_whole_row(job, physical, work.frames, threads, stages, folder.path()));
    }
  }
}

}  // namespace

std::vector<ConvertRow> run_convert_suite(const MaterialLibrary& materials,
                                          const std::function<void(const std::string&)>& announce) {
  constexpr int kFactor = 6;  // to 3840 x 3072
  std::vector<ConvertRow> rows;
  const BenchScene scene = rolling_ground();
  add_rows(scene, materials, {.frames = 60, .threads = {1, 0}}, announce, rows);
  add_rows(enlarged(scene, kFactor), materials, {.frames = 2, .threads = {0}}, announce, rows);
  return rows;
}

}  // namespace thermal
