#include "bench/memory_rows.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <malloc.h>

#include "base/parallel.h"
#include "bench/engine_scenes.h"
#include "raycast/ray_caster.h"

namespace thermal {
namespace {

/// A line of /proc/self/status, such as "VmHWM:" [MB].
double status_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kib = 0;
  while (status >> word) {
    if (word == name && status >> kib) return 1024e-6 * kib;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Resets the peak to the present use: proc(5).
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

PeakMemory::PeakMemory() {
  ::malloc_trim(0);
  before_mb_ = reset_peak() ? status_mb("VmHWM:") : std::numeric_limits<double>::quiet_NaN();
}

double PeakMemory::grown_mb() const { return std::round(10 * (status_mb("VmHWM:") - before_mb_)) / 10; }

namespace {

constexpr double kSideM = 1600;
constexpr std::size_t kCells = 400;  // of the terrain, along each side
constexpr std::size_t kBones = 20;
constexpr Transform<double> kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

struct Mesh {
  std::vector<std::array<float, 3>> points_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint16_t> material_index;

  [[nodiscard]] BakedMesh baked() {
    material_index.assign(triangles.size(), 1);
    return {.name = {},
            .smooth = true,
            .points_m = points_m,
            .triangles = triangles,
            .material_index = material_index};
  }
};

double ground_m(double x_m, double y_m) { return 5 * std::sin(0.02 * x_m) * std::sin(0.03 * y_m); }

/// Hills around the origin.
Mesh terrain() {
  Mesh mesh;
  for (std::size_t k = 0; k < (kCells + 1) * (kCells + 1); ++k) {
    const std::size_t column = k % (kCells + 1);
    const std::size_t row = k / (kCells + 1);
    const double x_m = kSideM * (static_cast<double>(column) / kCells - 0.5);
    const double y_m = kSideM * (static_cast<double>(row) / kCells - 0.5);
    mesh.points_m.push_back(
        {static_cast<float>(x_m), static_cast<float>(y_m), static_cast<float>(ground_m(x_m, y_m))});
  }
  for (std::size_t k = 0; k < kCells * kCells; ++k) {
    const auto a = static_cast<std::uint32_t>(k / kCells * (kCells + 1) + k % kCells);
    const auto b = static_cast<std::uint32_t>(a + kCells + 1);
    mesh.triangles.push_back({a, a + 1, b + 1});
    mesh.triangles.push_back({a, b + 1, b});
  }
  return mesh;
}

/// A pyramid of 1 m with four sides.
Mesh plant() {
  return {.points_m = {{-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}, {0, 0, 1}},
          .triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
          .material_index = {}};
}

/// A terrain with this many plants on a grid, and an actor; not copyable, because spans refer to it.
class Grove {
 public:
  explicit Grove(std::size_t plants) : terrain_(terrain()), plant_(thermal::plant()) {
    const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(plants))));
    const double spacing_m = kSideM / static_cast<double>(columns);
    for (std::size_t k = 0; k < plants; ++k) {
      const std::size_t column = k % columns;
      const std::size_t row = k / columns;
      const double x_m = spacing_m * (static_cast<double>(column) + 0.5) - kSideM / 2;
      const double y_m = spacing_m * (static_cast<double>(row) + 0.5) - kSideM / 2;
      transforms_.push_back({1, 0, 0, x_m, 0, 1, 0, y_m, 0, 0, 1, ground_m(x_m, y_m)});
    }
    meshes_.assign(plants, 1);
    scene_.depth_range_m = {0.1, 2 * kSideM};
    scene_.meshes = {terrain_.baked(), plant_.baked()};
    scene_.surfaces = {{.object = 1, .mesh = 0}};
    scene_.plants = {{.name = {}, .object = 2, .transform = transforms_, .mesh = meshes_}};
    scene_.actors.resize(1);
    scene_.actors[0].object = 3;
    scene_.actors[0].bones.assign(kBones, {.name = {}, .mesh = 1});
  }
  ~Grove() = default;
  Grove(const Grove&) = delete;
  Grove& operator=(const Grove&) = delete;

  [[nodiscard]] const BakedScene& scene() const noexcept { return scene_; }

 private:
  Mesh terrain_;
  Mesh plant_;
  std::vector<Transform<double>> transforms_;
  std::vector<std::uint32_t> meshes_;
  BakedScene scene_;
};

/// A flight over a grove, 61 m above the origin, looking down; the actor walks below.
class Flight {
 public:
  explicit Flight(std::size_t frames) : posed_(frames, 1), places_m_(frames), headings_rad_(frames) {
    for (std::size_t frame = 0; frame < frames; ++frame) {
      const double x_m = 0.05 * static_cast<double>(frame);
      poses_.push_back({1, 0, 0, x_m, 0, -1, 0, 0, 0, 0, -1, 61, 0, 0, 0, 1});
      for (std::size_t bone = 0; bone < kBones; ++bone) {
        Transform<float> to_world{};
        std::ranges::copy(kIdentity, to_world.begin());
        to_world[3] = static_cast<float>(x_m);
        to_world[11] = static_cast<float>(ground_m(x_m, 0) + 0.1 * static_cast<double>(bone));
        bones_.push_back(to_world);
      }
    }
  }

  [[nodiscard]] BakedTrack track() const {
    BakedTrack track;
    track.frames = poses_.size();
    track.camera_to_world = poses_;
    track.actor_position_m = places_m_;
    track.actor_heading_rad = headings_rad_;
    track.posed = posed_;
    track.bones = bones_;
    return track;
  }

 private:
  std::vector<std::array<double, 16>> poses_;
  std::vector<std::uint8_t> posed_;
  std::vector<Transform<float>> bones_;
  std::vector<std::array<double, 3>> places_m_;  ///< zeros: nothing here needs them
  std::vector<double> headings_rad_;
};

constexpr CameraIntrinsics kCamera = {
    .width_px = 640, .height_px = 512, .fx_px = 1167, .fy_px = 1167, .cx_px = 320, .cy_px = 256};

struct Cost {
  double build_s = 0;
  double frame_s = 0;
  double peak_mb = 0;
};

/// Cost of building the structures of a scene and tracing frames, without the scene itself.
Cost cost_of(const BakedScene& scene) {
  const PeakMemory memory;
  const auto start = std::chrono::steady_clock::now();
  const RayCaster caster(scene);
  const std::chrono::duration<double> built = std::chrono::steady_clock::now() - start;
  const Flight flight(2);
  const BakedTrack track = flight.track();
  Passes out;
  const double frame_s = frame_time_s({caster, track, kCamera}, track.frames, out);
  return {.build_s = built.count(), .frame_s = frame_s, .peak_mb = memory.grown_mb()};
}

RenderRow plants_row(std::size_t plants) {
  const Grove grove(plants);
  const Cost cost = cost_of(grove.scene());
  return {"memory by plants",
          fmt::format("{} plants", plants),
          {{"build_s", cost.build_s}, {"frame_s", cost.frame_s}, {"peak_mb", cost.peak_mb}}};
}

RenderRow threads_row(const BakedScene& scene, int threads) {
  const Cost cost = with_threads(threads, [&scene] { return cost_of(scene); });
  return {"memory by threads",
          fmt::format("{} {}, 100000 plants", threads, threads == 1 ? "thread" : "threads"),
          {{"build_s", cost.build_s}, {"frame_s", cost.frame_s}, {"peak_mb", cost.peak_mb}}};
}

/// Cost of a clip's poses and of tracing its frames one after another. Frames are small, because one picture's memory
/// does not depend on their number.
RenderRow frames_row(const RayCaster& caster, std::size_t frames) {
  constexpr CameraIntrinsics kSmall = {
      .width_px = 160, .height_px = 128, .fx_px = 292, .fy_px = 292, .cx_px = 80, .cy_px = 64};
  const PeakMemory memory;
  const Flight flight(frames);
  const BakedTrack track = flight.track();
  const ClipTracer tracer(caster, track, kSmall);
  Passes out;
  for (std::size_t frame = 0; frame < frames; ++frame)
    tracer.trace(frame, {.depth = true, .normals = true}, out);
  return {"memory by frames of a clip", fmt::format("{} frames", frames), {{"peak_mb", memory.grown_mb()}}};
}

}  // namespace

std::vector<RenderRow> memory_rows() {
  std::vector<RenderRow> rows;
  for (const std::size_t plants : {10'000U, 100'000U, 1'000'000U}) rows.push_back(plants_row(plants));
  const Grove grove(100'000);
  for (const int threads : {1, 2}) rows.push_back(threads_row(grove.scene(), threads));
  const RayCaster caster(grove.scene());
  for (const std::size_t frames : {10U, 100U, 1000U}) rows.push_back(frames_row(caster, frames));
  return rows;
}

}  // namespace thermal
