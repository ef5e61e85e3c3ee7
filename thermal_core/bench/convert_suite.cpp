#include "bench/convert_suite.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <sys/resource.h>

#include "base/parallel.h"
#include "bench/convert_stages.h"
#include "bench/measure.h"
#include "bench/sensor_scene.h"
#include "io/exr/passes_writer.h"
#include "io/system/temporary.h"

namespace thermal {
namespace {

double peak_mb() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return std::round(1024e-6 * static_cast<double>(used.ru_maxrss));  // Linux counts in KiB
}

struct Spent {
  double wall_ms = 0;
  double processor_ms = 0;
};

/// Cost per frame of a clip of `frames` frames.
Spent make(const ConvertJob& job, const ClipTask& task, int frames) {
  ClipPasses passes{.manifest = job.scene.manifest,
                    .folder = job.file.parent_path(),
                    .limits = {},
                    .bad_frames = BadFrames::fail};
  passes.manifest.frames.assign(static_cast<std::size_t>(frames), job.scene.manifest.frames[0]);
  for (ManifestFrame& frame : passes.manifest.frames) frame.file = job.file.filename().string();
  const double before_s = processor_s();
  const auto begin = std::chrono::steady_clock::now();
  (void)make_clip(passes, task, job.materials, {});
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - begin;
  return {.wall_ms = wall.count() / frames, .processor_ms = 1e3 * (processor_s() - before_s) / frames};
}

/// Rows of the stages of a model, and of both models.
std::vector<ConvertRow> stages_of(bool physical, const std::vector<ConvertRow>& stages) {
  std::vector<ConvertRow> own = stages;
  std::erase_if(own, [physical](const ConvertRow& row) {
    return row.name.ends_with(physical ? "published" : "physical") || row.limit.empty();
  });
  return own;
}

/// The slowest of the sequential stages: the camera, and the preview beside it.
const ConvertRow& slowest_in_order(const std::vector<ConvertRow>& stages) {
  const auto in_order_ms = [](const ConvertRow& row) {
    return row.name.starts_with("expose") || row.name == "preview" ? row.ms : 0;
  };
  return *std::max_element(stages.begin(), stages.end(), [&](const ConvertRow& one, const ConvertRow& other) {
    return in_order_ms(one) < in_order_ms(other);
  });
}

std::string bound_of(const Spent& spent, int threads, const std::vector<ConvertRow>& stages) {
  constexpr double kNearly = 0.8;
  double sum_ms = 0;
  for (const ConvertRow& row : stages) sum_ms += row.ms;
  const ConvertRow& in_order = slowest_in_order(stages);
  const ConvertRow& largest =
      *std::max_element(stages.begin(), stages.end(),
                        [](const ConvertRow& one, const ConvertRow& other) { return one.ms < other.ms; });
  if (threads > 1 && in_order.ms > kNearly * spent.wall_ms)
    return fmt::format("{}, which processes frames one by one", in_order.name);
  if (spent.processor_ms > kNearly * threads * spent.wall_ms)
    return fmt::format("the processors; {} is {:.0f} % of the stages' {:.1f} ms", largest.name,
                       100 * largest.ms / sum_ms, sum_ms);
  return "waiting: for the disk, or for processors used by other programs";
}

}  // namespace

ConvertRow convert_whole_row(const ConvertJob& job, bool physical, int frames, int threads,
                             const std::vector<ConvertRow>& stages, const Path& folder) {
  const int used = thread_count(threads);
  ClipTask task = physical ? job.physical : job.published;
  task.folder = folder / "whole";
  const Spent spent = with_threads(threads, [&] { return make(job, task, frames); });
  const CameraIntrinsics& camera = job.scene.manifest.camera;
  const auto file_bytes = static_cast<double>(std::filesystem::file_size(job.file));
  return {
      .group = fmt::format("{} x {}, from files to a clip", camera.width_px, camera.height_px),
      .name = fmt::format("{}, {} thread{}", physical ? "physical" : "published", used, used == 1 ? "" : "s"),
      .ms = spent.wall_ms,
      .mb_per_s = file_bytes / 1e3 / spent.wall_ms,
      .limit = "",
      .times_limit = 0,
      .bound = bound_of(spent, used, stages_of(physical, stages)),
      .figures = {{"frames_per_s", 1e3 / spent.wall_ms},
                  {"processor_ms", spent.processor_ms},
                  {"peak_mb", peak_mb()}}};
}

namespace {

ClipTask task_of(const BenchScene& scene) {
  ClipTask task;
  task.clip = {.id = scene.manifest.clip, .season = Season::winter, .frames = 1, .frame_rate_hz = 9};
  return task;
}

/// Every term that reads planes, and a camera with every stage.
ClipTask physical_task_of(const BenchScene& scene) {
  ClipTask task = task_of(scene);
  auto settings = std::make_shared<ClipSettings>();
  settings->sensor = full_camera();
  const Terms terms = {.variation = true,
                       .parts = true,
                       .sky = true,
                       .angular = true,
                       .mirror = true,
                       .path = true,
                       .falloff = false};
  task.physics = PhysicsSettings{.terms = terms,
                                 .weather = weather_of(Season::winter),
                                 .response = settings->sensor.response,
                                 .seed = 1};
  task.clip.settings = std::move(settings);
  return task;
}

/// Clips to convert end to end.
struct Whole {
  int frames = 0;
  std::vector<int> threads;  ///< 0: thread_count(0)
};

void add_rows(const BenchScene& scene, const MaterialLibrary& materials, const Whole& work,
              const std::function<void(const std::string&)>& announce, std::vector<ConvertRow>& rows) {
  const std::string size =
      fmt::format("{} x {}", scene.manifest.camera.width_px, scene.manifest.camera.height_px);
  const TemporaryFolder folder;
  const ConvertJob job{.scene = scene,
                       .file = folder.path() / "000000.exr",
                       .materials = materials,
                       .published = task_of(scene),
                       .physical = physical_task_of(scene)};
  write_passes(job.file, scene.passes, "Scene", "", ExrPacking::none);
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
