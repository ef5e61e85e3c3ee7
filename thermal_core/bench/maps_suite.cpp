#include "bench/maps_suite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/parallel.h"
#include "bench/measure.h"
#include "dataset/plan/plan_store.h"
#include "io/bake/baked_files.h"
#include "io/json/file.h"
#include "io/system/temporary.h"
#include "raycast/ground_light.h"
#include "raycast/ray_caster.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

constexpr std::size_t kReferenceRays = 2584;
constexpr int kStridePx = 16;  // between sampled pixels, along each axis

struct Case {
  std::string name;
  Json document;
};

/// The square of cells that a pixel averages: its south-western cell, and cells along its side.
using Square = std::pair<std::size_t, std::size_t>;

/// As in textures of the ground: the level whose cells are closest to the pixel, of at most 8 cells.
std::size_t cells_for(double pixel_cells) noexcept {
  std::size_t cells = 1;
  while (cells < 8 && pixel_cells > 1.5 * static_cast<double>(cells)) cells *= 2;
  return cells;
}

/// Number of sampled pixels per square.
std::map<Square, double> squares_in(const BakedScene& scene, const RayCaster& caster, const BakedTrack& track,
                                    const GroundMaps& maps) {
  std::set<std::uint16_t> ground;
  for (const BakedSurface& surface : scene.surfaces) ground.insert(surface.object);
  const CameraIntrinsics fine = track.camera.value_or(scene.camera);
  const CameraIntrinsics camera = {.width_px = fine.width_px / kStridePx,
                                   .height_px = fine.height_px / kStridePx,
                                   .fx_px = fine.fx_px / kStridePx,
                                   .fy_px = fine.fy_px / kStridePx,
                                   .cx_px = fine.cx_px / kStridePx,
                                   .cy_px = fine.cy_px / kStridePx};
  const CameraRays rays(camera);
  const ClipTracer tracer(caster, track, camera);
  const double cells_a_m = static_cast<double>(maps.cells) / maps.size_m;
  std::map<Square, double> squares;
  Passes passes;
  for (std::size_t frame = 0; frame < track.frames; ++frame) {
    tracer.trace(frame, {.depth = true}, passes);
    const std::array<double, 16>& pose = track.camera_to_world[frame];
    for (std::size_t k = 0; k < passes.object_index.size(); ++k) {
      if (!ground.contains(passes.object_index.pixels()[k])) continue;
      const auto depth_m = static_cast<double>(passes.depth_m.pixels()[k]);
      std::array<std::size_t, 2> cell{};
      bool inside = true;
      const std::size_t across = cells_for(cells_a_m * depth_m / fine.fx_px);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double along = pose[4 * axis] * static_cast<double>(rays.x().pixels()[k]) +
                             pose[4 * axis + 1] * static_cast<double>(rays.y().pixels()[k]) +
                             pose[4 * axis + 2];
        const double position = (pose[4 * axis + 3] + depth_m * along + maps.size_m / 2) * cells_a_m;
        inside = inside && position >= 0 && position < static_cast<double>(maps.cells - across);
        if (inside) cell[axis] = static_cast<std::size_t>(position) / across * across;
      }
      if (inside) squares[{cell[1] * maps.cells + cell[0], across}] += 1;
    }
  }
  return squares;
}

double sky_view(const GroundMaps& maps, const Square& square) noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < square.second * square.second; ++k)
    sum += maps.sky_view[square.first + k / square.second * maps.cells + k % square.second];
  return sum / 255 / static_cast<double>(square.second * square.second);
}

/// Rays for the blocks of these squares alone.
BlockRays reference_rays(const std::map<Square, double>& squares, std::size_t cells) {
  const std::size_t side = blocks_along(cells);
  BlockRays rays(side * side);
  for (const auto& [square, pixels] : squares)
    for (std::size_t k = 0; k < square.second * square.second; ++k) {
      const std::size_t cell = square.first + k / square.second * cells + k % square.second;
      rays[cell / cells / kBlockCells * side + cell % cells / kBlockCells] = kReferenceRays;
    }
  return rays;
}

RenderRow measured(const Case& one, const Path& folder, const MapsSuiteTask& task) {
  task.announce(one.name + ", planning");
  const ResolvedConfig config = resolve_config(one.document, one.name, task.assets);
  const PlanOptions options = {.assets = task.assets, .threads = task.threads};
  Json bare = one.document;
  bare["scene"]["temperatures"] = "table_1";  // the same plan without maps
  const PlanStore store(folder / one.name, task.assets);
  const DatasetPlan plan =
      store.plan(resolve_config(std::move(bare), one.name, task.assets), one.name, options).plan;
  task.announce(one.name);
  std::vector<SunDay> days;
  for (const SunPath& path : sun_paths(config.spec)) days.push_back({.path = path, .sun = sun_hours(path)});
  const double begin_s = processor_s();
  const BakedScene scene = store.scene(config.spec);
  const std::vector<GroundView> views = store.ground_views(plan, scene);
  const GroundMaps maps = make_ground_maps(scene, days, views);
  const double taken_s = processor_s() - begin_s;

  task.announce(one.name + ", 2584 rays");
  const BlockRays rays =
      rays_for(finest_pixels_m(scene, maps, views), maps.size_m / static_cast<double>(maps.cells));
  const auto traced = static_cast<double>(rays.size()) - static_cast<double>(std::ranges::count(rays, 0U));
  const RayCaster caster(scene);
  std::map<Square, double> squares;
  for (const ClipPlan& clip : plan.clips) {
    const BakedTrack track = store.track(clip.id, clip.frames, scene);
    for (const auto& [square, pixels] : squares_in(scene, caster, track, maps)) squares[square] += pixels;
  }
  GroundMaps reference = maps;
  trace_ground_light(caster, {}, reference_rays(squares, maps.cells), reference);
  double pixels = 0;
  double sum = 0;
  double sum2 = 0;
  for (const auto& [square, weight] : squares) {
    const double error = sky_view(maps, square) - sky_view(reference, square);
    pixels += weight;
    sum += weight * error;
    sum2 += weight * error * error;
  }
  return {.group = "maps of the ground",
          .name = one.name,
          .figures = {{"processor s", taken_s},
                      {"traced share", traced / static_cast<double>(rays.size())},
                      {"pixels", pixels},
                      {"sky view rms", std::sqrt(sum2 / pixels)},
                      {"mean", sum / pixels}}};
}

std::vector<Case> cases(const Assets& assets) {
  const auto document = [&assets](const char* name) {
    const Path file = assets.config(name);
    return resolve_config(read_json(file), file.string(), assets).document;
  };
  Json horizon = document("savanna");
  Json clip = horizon.at("clips").back();
  clip["frames"] = 4;
  clip["flight"]["look_angle_deg"] = 8;
  horizon["clips"] = Json::array({std::move(clip)});
  return {{.name = "demo", .document = document("demo")},
          {.name = "savanna", .document = document("savanna")},
          {.name = "savanna horizon", .document = std::move(horizon)}};
}

}  // namespace

std::vector<RenderRow> run_maps_suite(const MapsSuiteTask& task) {
  const TemporaryFolder folder;
  return with_threads(task.threads, [&] {
    std::vector<RenderRow> rows;
    for (const Case& one : cases(task.assets)) rows.push_back(measured(one, folder.path(), task));
    return rows;
  });
}

}  // namespace thermal
