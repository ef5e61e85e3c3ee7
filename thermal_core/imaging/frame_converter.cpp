#include "imaging/frame_converter.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"
#include "sensor/thermal_camera.h"

namespace thermal {
namespace {

/// Uncovered fractions; empty if all are zero.
Plane<float> uncovered(const std::vector<CoverageRank>& ranks) {
  Plane<float> left(ranks.front().coverage.width_px(), ranks.front().coverage.height_px(), 1.0F);
  const auto pixels = left.pixels();
  for (const CoverageRank& rank : ranks) {
    const auto coverage = rank.coverage.pixels();
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] -= coverage[i];
  }
  const bool any = std::any_of(pixels.begin(), pixels.end(), [](float share) { return share > 0; });
  return any ? std::move(left) : Plane<float>();
}

/// Adds the radiance of a fraction of each pixel. Rounded sums of coverages may exceed 1, so fractions may be
/// negative.
void add_weighted(const Plane<float>& radiance, const Plane<float>& share, Plane<float>& sum) {
  const auto out = sum.pixels();
  const auto from = radiance.pixels();
  const auto weight = share.pixels();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += std::max(weight[i], 0.0F) * from[i];
}

}  // namespace

PassChecks coverage_radiance(const SceneRadiance& scene, const Passes& passes, const ManifestFrame& frame,
                             Plane<float>& out) {
  assert(!passes.ranks.empty());
  const PassNeeds needs = scene.needs();
  Passes one;
  if (needs.depth) one.depth_m = passes.depth_m;
  if (needs.normals) one.normal = passes.normal;
  one.material_index = passes.material_index;
  out = Plane<float>(passes.object_index.width_px(), passes.object_index.height_px());
  Plane<float> radiance;
  PassChecks checks;
  for (const CoverageRank& rank : passes.ranks) {
    one.object_index = rank.object_index;
    const PassChecks of_rank = scene.radiance(one, frame, radiance);
    if (&rank == &passes.ranks.front()) checks = of_rank;  // depth and normals are those of rank 0
    add_weighted(radiance, rank.coverage, out);
    one.material_index = {};
  }
  const Plane<float> left = uncovered(passes.ranks);
  if (left.empty()) return checks;
  one.object_index = Plane<std::uint16_t>(out.width_px(), out.height_px(), kSkyIndex);
  scene.radiance(one, frame, radiance);
  add_weighted(radiance, left, out);
  return checks;
}

namespace {

SceneRadiance make_scene(const Manifest& manifest, const MaterialLibrary& materials,
                         const SceneSettings& settings) {
  if (settings.physics) return {manifest, materials, *settings.physics};
  return {manifest, materials, settings.season, radiance_of(settings.radiance, settings.response)};
}

/// Remaining resampling of passes whose rays follow the lens: at most cropping of the overscan.
std::shared_ptr<const ResampleMap> make_crop(const Manifest& manifest, const LensDistortion& lens) {
  if (lens != manifest.lens) {
    throw ConfigError(
        fault(fmt::format("clip {}: camera.distortion", manifest.clip), name_of(lens), "",
              fmt::format("{}, the lens that the rays of these passes follow", name_of(manifest.lens))));
  }
  if (manifest.overscan_px == 0) return nullptr;
  return std::make_shared<const ResampleMap>(manifest.camera, manifest.overscan_px, LensDistortion());
}

std::shared_ptr<const ResampleMap> make_map(const Manifest& manifest, const LensDistortion& lens) {
  if (!manifest.lens.is_none()) return make_crop(manifest, lens);
  const int needed_px = overscan_px(manifest.camera, lens);
  if (manifest.overscan_px < needed_px) {
    throw ConfigError(fault(
        fmt::format("clip {}: overscan_px", manifest.clip), fmt::format("{}", manifest.overscan_px), "px",
        fmt::format("at least {} px for this lens distortion (render.overscan_px), or a manifest "
                    "whose camera is smaller than its passes",
                    needed_px)));
  }
  if (lens.is_none() && manifest.overscan_px == 0) return nullptr;
  return std::make_shared<const ResampleMap>(manifest.camera, manifest.overscan_px, lens);
}

}  // namespace

SceneSettings scene_settings(Season season, const SensorParameters& parameters,
                             const std::optional<PhysicsSettings>& physics, const LensDistortion& lens) {
  return {.season = season,
          .response = parameters.response,
          .radiance = parameters.radiance,
          .table_is_brightest = parameters.agc.mode == AgcMode::table_max,
          .physics = physics,
          .lens = lens};
}

FrameConverter::FrameConverter(const Manifest& manifest, const MaterialLibrary& materials,
                               const SceneSettings& settings)
    : supersample_(manifest.supersample),
      has_quarters_(pixel_sampling(manifest, settings.lens).quarters),
      map_(make_map(manifest, settings.lens)),
      scene_radiance_(make_scene(manifest, materials, settings)),
      brightest_w_m2_sr_(settings.table_is_brightest
                             ? brightest_of_table_1(materials, settings.season,
                                                    radiance_of(settings.radiance, settings.response))
                             : scene_radiance_.brightest_w_m2_sr()),
      labeller_(manifest, settings.lens, map_),
      has_actor_layer_(!manifest.actor_layer.empty()) {}

FrameConverter::FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                               const SensorParameters& parameters,
                               const std::optional<PhysicsSettings>& physics, const LensDistortion& lens)
    : FrameConverter(manifest, materials, scene_settings(season, parameters, physics, lens)) {}

PassNeeds FrameConverter::needs() const noexcept {
  PassNeeds needs = scene_radiance_.needs();
  needs.actors = has_actor_layer_;
  needs.depth_if_there = labeller_.wants_depth();
  return needs;
}

SceneFrame FrameConverter::convert(const Passes& passes, const ManifestFrame& frame) const {
  SceneFrame scene;
  convert(passes, frame, scene);
  return scene;
}

void FrameConverter::convert(const Passes& passes, const ManifestFrame& frame, SceneFrame& out) const {
  if (passes.fine.factor > 1) {
    convert_samples(passes, frame, out);
    return;
  }
  const std::vector<IndexUse> uses = survey_indices(passes.object_index);
  const SurfaceMap& surfaces = scene_radiance_.surfaces();
  surfaces.check_objects(uses);
  for (const CoverageRank& rank : passes.ranks) surfaces.check_objects(survey_indices(rank.object_index));
  if (!passes.material_index.empty()) surfaces.check_materials(survey_indices(passes.material_index));
  if (!passes.mirrored.empty()) {
    surfaces.check_objects(survey_indices(passes.mirrored.object_index));
    surfaces.check_materials(survey_indices(passes.mirrored.material_index));
  }
  out.instances = labeller_.label(passes, uses, frame);
  if (supersample_ == 1 && !map_) {
    out.checks = radiance(passes, frame, out.radiance_w_m2_sr);
    return;
  }
  Plane<float> fine;
  out.checks = radiance(passes, frame, fine);
  reshape(std::move(fine), out);
}

/// Labels are those of the expanded planes.
void FrameConverter::convert_samples(const Passes& passes, const ManifestFrame& frame,
                                     SceneFrame& out) const {
  const FineSamples& fine = passes.fine;
  Passes labelled;
  labelled.object_index = filled_in(passes.object_index, fine.object_index, fine);
  labelled.actor_index = filled_in(passes.actor_index, fine.actor_index, fine);
  if (labeller_.wants_depth() && !fine.depth_m.empty())
    labelled.depth_m = filled_in(passes.depth_m, fine.depth_m, fine);
  const std::vector<IndexUse> uses = survey_indices(labelled.object_index);
  scene_radiance_.surfaces().check_objects(uses);
  scene_radiance_.surfaces().check_materials(survey_indices(passes.material_index));
  out.instances = labeller_.label(labelled, uses, frame);
  Plane<float> radiance;
  out.checks = scene_radiance_.radiance(passes, frame, map_ ? radiance : out.radiance_w_m2_sr);
  if (has_quarters_)
    clear_detail(passes.object_index.width_px(), passes.object_index.height_px(), out.detail);
  out.checks += scene_radiance_.refine(fine, frame, map_ ? radiance : out.radiance_w_m2_sr,
                                       has_quarters_ ? &out.detail : nullptr);
  if (map_) map_->resample_linear(radiance, out.radiance_w_m2_sr);
}

/// Radiance at the resolution of the passes.
PassChecks FrameConverter::radiance(const Passes& passes, const ManifestFrame& frame,
                                    Plane<float>& out) const {
  if (passes.ranks.empty()) return scene_radiance_.radiance(passes, frame, out);
  return coverage_radiance(scene_radiance_, passes, frame, out);
}

/// Resamples the passes' pixels to the camera's.
void FrameConverter::reshape(Plane<float> fine, SceneFrame& out) const {
  if (has_quarters_) {
    mean_quarters(fine, supersample_, out.radiance_w_m2_sr, out.detail);
    return;
  }
  Plane<float> radiance = supersample_ > 1 ? block_means(fine, supersample_) : std::move(fine);
  if (map_) {
    map_->resample_linear(radiance, out.radiance_w_m2_sr);
  } else {
    out.radiance_w_m2_sr = std::move(radiance);
  }
}

}  // namespace thermal
