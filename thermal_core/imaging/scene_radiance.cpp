#include "imaging/scene_radiance.h"

#include <algorithm>
#include <cassert>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

constexpr std::size_t kSceneRowsAChunk = 8;

/// In the planes' precision, so that pixels of the brightest material have exactly the brightest count.
float emitted(const Material& material, Season season, const SceneRadiance::RadianceOf& radiance_of) {
  return static_cast<float>(material.emissivity * radiance_of(material.temperature_k(season)));
}

EmissivitySpectrum spectrum_of(const Material& material) {
  return material.spectrum.value_or(EmissivitySpectrum(material.emissivity));
}

/// The field's values stay within 6 standard deviations, and the tables that convert it to radiance are limited.
void check_varied_range(const Material& material, double mean_k) {
  const double reach_k = 6 * material.variation.stddev_k;
  constexpr auto kLow = static_cast<double>(RadianceTable::kColdest);
  constexpr auto kHigh = static_cast<double>(RadianceTable::kHottest);
  if (mean_k - reach_k >= kLow && mean_k + reach_k < kHigh) return;
  throw ConfigError(
      fmt::format("material {}: variation about {:.1f} K by up to {:.1f} K; expected within {} K to {} K",
                  material.name, mean_k, reach_k, kLow, kHigh));
}

void require_poses(const Manifest& manifest) {
  for (std::size_t i = 0; i < manifest.frames.size(); ++i) {
    if (manifest.frames[i].camera_to_world) continue;
    throw ConfigError("frames[" + std::to_string(i) +
                      "].camera_to_world is missing; expected in every frame by the chosen terms");
  }
}

}  // namespace

SceneRadiance::SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                             const RadianceOf& radiance_of)
    : map_(manifest, materials) {
  for (const Surface& surface : map_.surfaces()) {
    held_->optics.push_back({.emitted_w_m2_sr = emitted(*surface.material, season, radiance_of)});
  }
  chain_.push_back(emission(held_->optics));
  find_brightest();
}

SceneRadiance::SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials,
                             const PhysicsSettings& settings)
    : map_(manifest, materials) {
  held_->rays = std::make_unique<CameraRays>(passes_camera(manifest));
  for (const Surface& surface : map_.surfaces()) add_optics(surface, settings);
  compose(settings);
  const Terms& terms = settings.terms;
  if (terms.variation || terms.sky || terms.angular) require_poses(manifest);
  find_brightest();
}

void SceneRadiance::add_optics(const Surface& surface, const PhysicsSettings& settings) {
  const Material& material = *surface.material;
  const BandRadiance blackbody(settings.response);
  const BandRadiance band(settings.response, spectrum_of(material));
  const Weather& weather = settings.weather;
  const double air_k = weather.air.temperature_k;
  const double temperature_k = material.part_temperature_k(settings.terms.parts ? surface.part : "", weather);
  SurfaceOptics optics;
  const bool is_sky = held_->optics.empty();
  optics.temperature_k = static_cast<float>(temperature_k);
  optics.emitted_w_m2_sr = static_cast<float>(is_sky ? sky_emissivity(weather.air) * blackbody.radiance(air_k)
                                                     : band.radiance(temperature_k));
  optics.emitted_as_air_w_m2_sr = static_cast<float>(band.radiance(air_k));
  optics.reflected_air_w_m2_sr =
      is_sky ? 0.0F : static_cast<float>(blackbody.radiance(air_k) - band.radiance(air_k));
  optics.angular = material.angular;
  if (settings.terms.variation && material.variation.stddev_k > 0) {
    check_varied_range(material, temperature_k);
    optics.variation_stddev_k = static_cast<float>(material.variation.stddev_k);
    optics.per_correlation_length = static_cast<float>(1 / material.variation.correlation_length_m);
    optics.table = held_->tables.emplace_back(std::make_unique<RadianceTable>(band)).get();
  }
  held_->optics.push_back(optics);
}

void SceneRadiance::compose(const PhysicsSettings& settings) {
  const Terms& terms = settings.terms;
  const SurfaceOpticsList& optics = held_->optics;
  const CameraRays& rays = *held_->rays;
  if (terms.variation) {
    held_->field = std::make_unique<VariationField>(settings.seed);
    chain_.push_back(varied_emission(optics, *held_->field, rays));
  } else {
    chain_.push_back(emission(optics));
  }
  if (terms.sky) chain_.push_back(reflectivity(optics));
  if (terms.sky || terms.angular) {
    chain_.push_back(orientation(rays));
    chain_.push_back(water_pixels(optics));
  }
  if (terms.angular) chain_.push_back(angular_emissivity(optics));
  if (terms.sky) chain_.push_back(sky_reflection(settings.weather.air));
  if (terms.path) {
    const double air_radiance = BandRadiance(settings.response).radiance(settings.weather.air.temperature_k);
    chain_.push_back(path(settings.weather.air, static_cast<float>(air_radiance), rays));
  }
  needs_ = {.depth = terms.variation || terms.path, .normals = terms.sky || terms.angular};
}

void SceneRadiance::find_brightest() {
  const auto& optics = held_->optics;
  brightest_w_m2_sr_ = optics.front().emitted_w_m2_sr;
  if (optics.size() == 1) return;
  const auto dimmer = [](const SurfaceOptics& a, const SurfaceOptics& b) {
    return a.emitted_w_m2_sr < b.emitted_w_m2_sr;
  };
  brightest_w_m2_sr_ = std::max_element(optics.begin() + 1, optics.end(), dimmer)->emitted_w_m2_sr;
}

void SceneRadiance::begin_row(const Passes& passes, int y, Row& row) const {
  row.y = y;
  if (needs_.depth) row.depth_m = passes.depth_m.row(y);
  for (std::size_t axis = 0; needs_.normals && axis < 3; ++axis)
    row.normal[axis] = passes.normal[axis].row(y);
}

Plane<float> SceneRadiance::radiance(const Passes& passes, const ManifestFrame& frame) const {
  Plane<float> plane;
  radiance(passes, frame, plane);
  return plane;
}

PassChecks SceneRadiance::radiance(const Passes& passes, const ManifestFrame& frame,
                                   Plane<float>& out) const {
  const Plane<std::uint16_t>& objects = passes.object_index;
  const bool has_materials = !passes.material_index.empty();
  assert(!has_materials || passes.material_index.size() == objects.size());
  const CameraPose pose = frame.camera_to_world ? pose_of(*frame.camera_to_world) : CameraPose{};
  if (out.width_px() != objects.width_px() || out.height_px() != objects.height_px()) {
    out = Plane<float>(objects.width_px(), objects.height_px());
  }
  const auto rows = static_cast<std::size_t>(objects.height_px());
  std::vector<PassChecks> checks((rows + kSceneRowsAChunk - 1) /
                                 kSceneRowsAChunk);  // a chunk each: sums of any order are equal
  parallel_for(rows, kSceneRowsAChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint16_t> numbers(static_cast<std::size_t>(objects.width_px()));
    Row row;
    row.pose = &pose;
    row.surface = numbers;
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      const auto materials = has_materials ? passes.material_index.row(y) : std::span<const std::uint16_t>();
      map_.number(objects.row(y), materials, numbers);
      begin_row(passes, y, row);
      checks[begin / kSceneRowsAChunk] += check_row(row);
      row.radiance_w_m2_sr = out.row(y);
      for (const RowTerm& term : chain_) term(row);
    }
  });
  PassChecks sum;
  for (const PassChecks& chunk : checks) sum += chunk;
  return sum;
}

float brightest_of_table_1(const MaterialLibrary& materials, Season season,
                           const SceneRadiance::RadianceOf& radiance_of) {
  float brightest = 0;
  for (const auto& [name, material] : materials.all()) {
    if (material.in_table_1) brightest = std::max(brightest, emitted(material, season, radiance_of));
  }
  return brightest;
}

}  // namespace thermal
