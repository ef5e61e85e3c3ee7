#include "bench/labels_suite.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/parallel.h"
#include "bench/sensor_scene.h"
#include "dataset/clip/annotations.h"
#include "imaging/actor_labeller.h"
#include "imaging/target_contrast.h"
#include "radiometry/band_radiance.h"
#include "sensor/thermal_camera.h"

namespace thermal {
namespace {

using IndexPlane = Plane<std::uint16_t>;

constexpr std::uint16_t kGround = 1;
constexpr std::uint16_t kPlant = 3;
constexpr std::uint16_t kFirstActor = 101;
constexpr int kColumns = 10;
constexpr int kRows = 5;

/// Half widths of an actor [px]: 3 to 22 wide, from people to near elephants.
double half_width_px(int actor) { return 3 + 19 * std::fmod(0.618 * actor, 1); }

/// The actor at a pixel, ignoring occlusion; 0 for none.
std::uint16_t actor_at(int x, int y) {
  const int column = x * kColumns / kSceneWidthPx;
  const int row = y * kRows / kSceneHeightPx;
  const int actor = row * kColumns + column;
  const double across = x + 0.5 - (column + 0.5) * kSceneWidthPx / kColumns;
  const double down = y + 0.5 - (row + 0.5) * kSceneHeightPx / kRows;
  const double half_px = half_width_px(actor);
  const double edge = 1 + 0.2 * std::sin(5 * std::atan2(down, across));  // limbs
  const bool inside = std::hypot(across / half_px, down / (1.6 * half_px)) < 0.8 * edge;
  return inside ? static_cast<std::uint16_t>(kFirstActor + actor) : std::uint16_t{0};
}

/// Patches of plants some pixels across, and a trunk in front of every third actor.
bool is_plant(int x, int y) {
  const int cell = kSceneWidthPx / kColumns;
  if ((x / cell) % 3 == 1 && std::abs(x % cell - cell / 2) < 2) return true;
  return std::sin(0.31 * x + 2 * std::sin(0.07 * y)) * std::sin(0.37 * y) > 0.6 && actor_at(x, y) == 0;
}

Passes passes_with_actors() {
  Passes passes;
  passes.object_index = IndexPlane(kSceneWidthPx, kSceneHeightPx, kGround);
  passes.actor_index = IndexPlane(kSceneWidthPx, kSceneHeightPx);
  for (int y = 0; y < kSceneHeightPx; ++y) {
    for (int x = 0; x < kSceneWidthPx; ++x) {
      const std::uint16_t actor = actor_at(x, y);
      passes.actor_index.at(x, y) = actor;
      if (actor != 0) passes.object_index.at(x, y) = actor;
      if (is_plant(x, y)) passes.object_index.at(x, y) = kPlant;
    }
  }
  return passes;
}

/// A manifest as a renderer writes it; positions are synthetic, and the camera looks straight down.
Manifest manifest_of_actors() {
  Manifest manifest;
  manifest.clip = "bench";
  manifest.frame_rate_hz = kSceneRateHz;
  manifest.camera = {.width_px = kSceneWidthPx,
                     .height_px = kSceneHeightPx,
                     .fx_px = 765,
                     .fy_px = 765,
                     .cx_px = kSceneWidthPx / 2.0,
                     .cy_px = kSceneHeightPx / 2.0};
  ManifestFrame frame;
  frame.camera_to_world = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 61, 0, 0, 0, 1};
  for (int actor = 0; actor < kColumns * kRows; ++actor) {
    ManifestObject object;
    object.index = static_cast<std::uint16_t>(kFirstActor + actor);
    object.object_class = ObjectClass::actor;
    object.category = "zebra";
    object.track_id = object.index;
    object.bounds_m = {{{-1, -0.5, 0}, {1, 0.5, 1.5}}};
    manifest.objects.push_back(object);
    frame.actors.push_back(
        {.index = object.index, .position_m = {actor * 0.5, 0, 0}, .heading_rad = 0.1 * actor});
  }
  manifest.frames.push_back(frame);
  return manifest;
}

/// A frame and everything needed to label it.
struct LabelScene {
  Manifest manifest = manifest_of_actors();
  Passes passes = passes_with_actors();
  Plane<float> radiance_w_m2_sr = scene_radiance(full_camera().response);
  ThermalCamera camera{full_camera(), scene_clip(), 60};
  ActorLabeller labeller{manifest, {}, nullptr};
  IndexSet actors;

  LabelScene() {
    std::vector<std::uint16_t> indices;
    for (const ManifestObject& object : manifest.objects) indices.push_back(object.index);
    actors = IndexSet(indices);
  }

  [[nodiscard]] std::vector<Instance> labelled() const {
    return labeller.label(passes, survey_indices(passes.object_index), manifest.frames[0]);
  }

  [[nodiscard]] std::vector<Instance> measured() const {
    std::vector<Instance> instances = labelled();
    set_contrast(camera, radiance_w_m2_sr, instances);
    return instances;
  }

  [[nodiscard]] std::string text_of(const std::vector<Instance>& instances) const {
    ClipAnnotations annotations(manifest);
    annotations.add_frame(0, instances);
    std::string text;
    annotations.write([&text](std::string_view piece) { text += piece; });
    return text;
  }
};

double wrong_px(const LabelScene& scene) {
  int wrong = 0;
  for (const Instance& instance : scene.labelled()) {
    const RunLengths runs = decode_coco_rle(encode_coco_rle(instance.mask));
    std::vector<bool> set;
    for (std::size_t i = 0; i < runs.size(); ++i) set.insert(set.end(), runs[i], i % 2 == 1);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const int y = static_cast<int>(i % kSceneHeightPx);
      const int x = static_cast<int>(i / kSceneHeightPx);
      wrong += (scene.passes.object_index.at(x, y) == instance.index) != set[i];
    }
  }
  return wrong;
}

double worst_visibility(const LabelScene& scene) {
  const auto pixels_of = [](const IndexPlane& plane, std::uint16_t index) {
    return static_cast<double>(std::count(plane.pixels().begin(), plane.pixels().end(), index));
  };
  double worst = 0;
  for (const Instance& instance : scene.labelled()) {
    const double exact = pixels_of(scene.passes.object_index, instance.index) /
                         pixels_of(scene.passes.actor_index, instance.index);
    worst = std::max(worst, std::abs(instance.visibility.value_or(2) - exact));
  }
  return worst;
}

/// Contrast by its definition, over every pixel of the frame.
double exact_contrast_k(const LabelScene& scene, const Instance& instance, const BandRadiance& band) {
  const PixelBox& box = instance.box;
  const int reach_px = 2 + std::max(4, (std::max(box.width_px, box.height_px) + 1) / 2);
  double target = 0;
  double ring = 0;
  int ring_pixels = 0;
  for (int y = 0; y < kSceneHeightPx; ++y) {
    for (int x = 0; x < kSceneWidthPx; ++x) {
      const auto radiance = static_cast<double>(scene.radiance_w_m2_sr.at(x, y));
      const std::uint16_t index = scene.passes.object_index.at(x, y);
      if (index == instance.index) target += radiance;
      const int beyond_px = std::max({box.x_px - x, x - (box.x_px + box.width_px - 1), box.y_px - y,
                                      y - (box.y_px + box.height_px - 1)});
      if (beyond_px <= 2 || beyond_px > reach_px || index >= kFirstActor) continue;
      ring += radiance;
      ++ring_pixels;
    }
  }
  return band.temperature(target / instance.area_px) - band.temperature(ring / ring_pixels);
}

double worst_mk(const LabelScene& scene) {
  const BandRadiance band(full_camera().response);
  double worst_k = 0;
  for (const Instance& instance : scene.measured()) {
    const double error_k = instance.contrast_k.value_or(0) - exact_contrast_k(scene, instance, band);
    worst_k = std::max(worst_k, std::abs(error_k));
  }
  return 1e3 * worst_k;
}

StageRow row_of(const std::string& name, std::vector<Figure> figures) {
  return {.group = "labels", .name = name, .figures = std::move(figures)};
}

std::vector<StageRow> labels_rows() {
  const LabelScene scene;
  const IndexPlane& plane = scene.passes.object_index;
  const std::vector<IndexUse> uses = survey_indices(plane);
  const std::vector<Instance> labelled = scene.labelled();
  std::vector<Instance> measured = scene.measured();
  const auto labels = static_cast<double>(measured.size());
  const auto bytes = static_cast<double>(scene.text_of(measured).size());
  constexpr std::size_t kIndexBytes = sizeof(std::uint16_t);
  constexpr std::size_t kAllBytes = 2 * kIndexBytes + sizeof(float);
  return {timed(row_of("survey of an index plane", {{"indices", static_cast<double>(uses.size())}}),
                kIndexBytes, [&] { (void)survey_indices(plane); }),
          timed(row_of("boxes and masks", {{"wrong_px", wrong_px(scene)}}), kIndexBytes,
                [&] { (void)extract_instances(plane, uses, scene.actors); }),
          timed(row_of("masks, actor layer, places", {{"worst_visibility", worst_visibility(scene)}}),
                2 * kIndexBytes,
                [&] { (void)scene.labeller.label(scene.passes, uses, scene.manifest.frames[0]); }),
          timed(row_of("contrast", {{"worst_mk", worst_mk(scene)}}), sizeof(float),
                [&] { set_contrast(scene.camera, scene.radiance_w_m2_sr, measured); }),
          timed(row_of("JSON, a clip of one frame", {{"labels", labels}, {"bytes", bytes}}), 0,
                [&] { (void)scene.text_of(measured); }),
          timed(row_of("everything", {{"labels", labels}}), kAllBytes,
                [&] { (void)scene.text_of(scene.measured()); })};
}

}  // namespace

std::vector<StageRow> run_labels_suite() { return with_threads(1, labels_rows); }

}  // namespace thermal
