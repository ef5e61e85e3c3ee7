#include "imaging/scene_radiance.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <string>

#include <fmt/core.h>

#include "base/error.h"
#include "base/parallel.h"
#include "heat/weather/air_profile.h"
#include "imaging/actor_states.h"
#include "imaging/sampling.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

constexpr std::size_t kSceneRowsPerChunk = 8;

/// In single precision, as the planes, so that pixels of the brightest material have exactly the brightest level.
float emitted(const Material& material, Season season, const SceneRadiance::RadianceOf& radiance_of) {
  return static_cast<float>(material.emissivity * radiance_of(material.temperature_k(season)));
}

EmissivitySpectrum spectrum_of(const Material& material, bool measured) {
  return material.spectrum.value_or(
      EmissivitySpectrum(measured ? material.measured_emissivity : material.emissivity));
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

/// Whether camera poses are known. Otherwise the sky has its mean everywhere.
bool has_poses(const Manifest& manifest) {
  return !manifest.frames.empty() && std::ranges::all_of(manifest.frames, [](const ManifestFrame& frame) {
    return frame.camera_to_world.has_value();
  });
}

void require_poses(const Manifest& manifest) {
  for (std::size_t i = 0; i < manifest.frames.size(); ++i) {
    if (manifest.frames[i].camera_to_world) continue;
    throw ConfigError("frames[" + std::to_string(i) +
                      "].camera_to_world is missing; expected in every frame by the chosen terms");
  }
}

CameraPose pose_in(const ManifestFrame& frame) {
  return frame.camera_to_world ? pose_of(*frame.camera_to_world) : CameraPose{};
}

bool knows_ground(const SceneHeat& heat) { return heat.ground.has_value(); }

/// Sums the results of work(begin, end) over chunks of the rows, in any order.
template <typename Work>
PassChecks sum_over_rows(int rows, const Work& work) {
  const auto count = static_cast<std::size_t>(rows);
  std::vector<PassChecks> checks((count + kSceneRowsPerChunk - 1) / kSceneRowsPerChunk);
  parallel_for(count, kSceneRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    checks[begin / kSceneRowsPerChunk] = work(static_cast<int>(begin), static_cast<int>(end));
  });
  PassChecks sum;
  for (const PassChecks& chunk : checks) sum += chunk;
  return sum;
}

PhysicsSettings of_clip(PhysicsSettings settings, const Manifest& manifest) {
  settings.weather = with_inversion(settings, manifest);
  return settings;
}

}  // namespace

Weather with_inversion(const PhysicsSettings& settings, const Manifest& manifest) {
  constexpr double kUsualHeightM = 61;
  Weather weather = settings.weather;
  if (!weather.inversion_by_balance || !settings.heat) return weather;
  double sum_m = 0;
  int known = 0;
  for (const ManifestFrame& frame : manifest.frames) {
    if (!frame.agl_m) continue;
    sum_m += *frame.agl_m;
    ++known;
  }
  const HeatOfMoment moment = settings.heat->day->at(weather.solar_h);
  const StableAir air(moment.forcing, moment.ground_k);
  weather.air.inversion_k =
      std::min(kLargestInversionK, air.warmer_k(known > 0 ? sum_m / known : kUsualHeightM));
  return weather;
}

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
    : SceneRadiance(manifest, materials, of_clip(settings, manifest),
                    settings.heat ? states_of_actors(manifest, materials, settings.weather, settings.seed)
                                  : ActorStates()) {}

SceneRadiance::SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials,
                             const PhysicsSettings& settings, const ActorStates& actors)
    : map_(manifest, materials, actors.classes) {
  held_->rays = std::make_unique<CameraRays>(passes_camera(manifest), manifest.lens);
  if (manifest.supersample > 1)
    held_->pixel_rays = std::make_unique<CameraRays>(pixels_camera(manifest), manifest.lens);
  if (settings.heat) add_heat(manifest, materials, settings, actors.states);
  for (std::size_t i = 0; i < map_.surfaces().size(); ++i) {
    const Surface& surface = map_.surfaces()[i];
    const bool parts = settings.terms.parts;
    add_optics(drawn_as(i, materials, settings),
               settings.heat ? held_->heat.middle_k(i)
                             : static_cast<float>(surface.material->part_temperature_k(
                                   parts ? surface.part : "", settings.weather)),
               settings);
  }
  compose(settings, has_poses(manifest));
  const Terms& terms = settings.terms;
  const bool by_place = knows_ground(held_->heat);
  const bool by_facing = settings.heat && terms.facing;
  if (terms.variation || terms.sky || terms.angular || by_place || by_facing) require_poses(manifest);
  find_brightest();
}

/// All ground with maps is drawn as bare soil; its temperatures distinguish its kinds.
const Material& SceneRadiance::drawn_as(std::size_t surface, const MaterialLibrary& materials,
                                        const PhysicsSettings& settings) const {
  const bool is_ground =
      settings.heat && held_->heat.spans.front().surfaces[surface].kind == HeatedSurface::Kind::ground;
  return is_ground ? materials.find(settings.heat->ground->covers.kinds.front(), "maps of the ground: kinds")
                   : *map_.surfaces()[surface].material;
}

void SceneRadiance::add_heat(const Manifest& manifest, const MaterialLibrary& materials,
                             const PhysicsSettings& settings, const std::vector<ActorState>& states) {
  const Terms& terms = settings.terms;
  const auto band_of = [&](const std::string& name) {
    return BandRadiance(settings.response,
                        spectrum_of(materials.find(name, "maps of the ground: kinds"), true));
  };
  std::optional<SoilAppearance> appearance;
  const bool by_place = terms.place && settings.heat->ground != nullptr;
  if (by_place) {
    const Air& air = settings.weather.air;
    appearance.emplace(band_of(settings.heat->ground->covers.kinds.front()), BandAir(air, settings.response),
                       air.temperature_k, terms.sky);
  }
  const auto appearance_of = [&](const std::string& name, double temperature_k) -> GroundAppearance {
    return {.shift = appearance->shift(band_of(name), temperature_k),
            .variation_k = materials.find(name, "maps of the ground: kinds").variation.stddev_k};
  };
  held_->heat = heat_of_scene(
      map_.surfaces(), states, *settings.heat, settings.weather, manifest,
      {.parts = terms.parts, .variation = terms.variation, .place = by_place, .facing = terms.facing},
      appearance_of, settings.seed);
  middle_s_ = middle_s(manifest);
  std::map<const Material*, std::size_t> table_of;
  for (std::size_t i = 0; i < map_.surfaces().size(); ++i) {
    const Material* material = &drawn_as(i, materials, settings);
    const auto [found, is_new] = table_of.emplace(material, held_->tables.size());
    if (is_new) {
      held_->tables.push_back(
          std::make_unique<RadianceTable>(BandRadiance(settings.response, spectrum_of(*material, true))));
    }
    for (HeatSpan& span : held_->heat.spans) span.surfaces[i].table = found->second;
  }
}

void SceneRadiance::add_optics(const Material& material, float surface_k, const PhysicsSettings& settings) {
  const BandRadiance blackbody(settings.response);
  const BandRadiance band(settings.response, spectrum_of(material, settings.heat.has_value()));
  const Weather& weather = settings.weather;
  const double air_k = weather.air.temperature_k;
  const auto temperature_k = static_cast<double>(surface_k);
  SurfaceOptics optics;
  const bool is_sky = held_->optics.empty();
  optics.temperature_k = surface_k;
  optics.emitted_w_m2_sr = static_cast<float>(
      is_sky ? BandAir(weather.air, settings.response).sky_emissivity() * blackbody.radiance(air_k)
             : band.radiance(temperature_k));
  optics.emitted_as_air_w_m2_sr = static_cast<float>(band.radiance(air_k));
  optics.reflected_air_w_m2_sr =
      is_sky ? 0.0F : static_cast<float>(blackbody.radiance(air_k) - band.radiance(air_k));
  optics.angular = material.angular;
  if (!settings.heat && settings.terms.variation && material.variation.stddev_k > 0) {
    check_varied_range(material, temperature_k);
    optics.variation_stddev_k = static_cast<float>(material.variation.stddev_k);
    optics.per_correlation_length = static_cast<float>(1 / material.variation.correlation_length_m);
    optics.table = held_->tables.emplace_back(std::make_unique<RadianceTable>(band)).get();
  }
  held_->optics.push_back(optics);
}

void SceneRadiance::compose(const PhysicsSettings& settings, bool has_poses) {
  const Terms& terms = settings.terms;
  const SurfaceOpticsList& optics = held_->optics;
  if (settings.heat) {
    held_->field = std::make_unique<VariationField>(settings.seed);
    chain_.push_back(heated_emission(held_->heat, held_->tables, *held_->field));
  } else if (terms.variation) {
    held_->field = std::make_unique<VariationField>(settings.seed);
    chain_.push_back(varied_emission(optics, *held_->field));
  } else {
    chain_.push_back(emission(optics));
  }
  const double air_radiance = BandRadiance(settings.response).radiance(settings.weather.air.temperature_k);
  const BandAir band_air(settings.weather.air, settings.response);
  if (has_poses) chain_.push_back(sky_emission(band_air, static_cast<float>(air_radiance)));
  if (terms.sky) chain_.push_back(reflectivity(optics));
  if (terms.sky || terms.angular) {
    chain_.push_back(orientation());
    chain_.push_back(water_pixels(optics));
  }
  if (terms.sky && knows_ground(held_->heat)) chain_.push_back(mapped_sky_view());
  if (terms.angular) chain_.push_back(angular_emissivity(optics));
  const RowTerm of_sky = sky_reflection(band_air);
  const RowTerm of_path = terms.path ? path(band_air, static_cast<float>(air_radiance)) : RowTerm();
  const bool mirrors = terms.mirror && terms.sky;
  if (mirrors) {
    std::vector<RowTerm> of_surfaces = chain_;
    of_surfaces.push_back(of_sky);
    chain_.push_back(mirrored_surfaces(std::move(of_surfaces), of_path, static_cast<float>(air_radiance)));
  }
  if (terms.sky) chain_.push_back(of_sky);
  if (of_path) chain_.push_back(of_path);
  const Air& air = settings.weather.air;
  if (of_path && air.inversion_k > 0) {
    const double at_camera = BandRadiance(settings.response).radiance(air.temperature_k + air.inversion_k);
    chain_.push_back(path_inversion(band_air, static_cast<float>(at_camera - air_radiance)));
  }
  needs_ = {.depth = terms.variation || terms.path || knows_ground(held_->heat) || mirrors,
            .normals = terms.sky || terms.angular || (settings.heat && terms.facing),
            .actors = false,
            .mirrored = mirrors};
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

float SceneRadiance::later_h(const ManifestFrame& frame) const noexcept {
  return static_cast<float>((frame.time_s - middle_s_) / 3600);
}

/// Prepares what a row's water mirrors. `numbers` receives the surfaces of the row, and is empty if none are mirrored.
void SceneRadiance::begin_mirrored(const Mirrored<Plane>& mirrored, int y, std::span<std::uint16_t> numbers,
                                   Row& row) const {
  if (numbers.empty()) return;
  const Plane<std::uint16_t>& materials = mirrored.material_index;
  map_.number(mirrored.object_index.row(y),
              materials.empty() ? std::span<const std::uint16_t>() : materials.row(y), numbers);
  row.mirrored_surface = numbers;
  row.mirrored_depth_m = mirrored.depth_m.row(y);
  for (std::size_t axis = 0; axis < 3; ++axis) row.mirrored_normal[axis] = mirrored.normal[axis].row(y);
}

void SceneRadiance::begin_row(const Passes& passes, const CameraRays* rays, int y, Row& row) const {
  if (rays != nullptr) {
    row.ray_x = rays->x().row(y);
    row.ray_y = rays->y().row(y);
    row.ray_length = rays->length().row(y);
    row.sample_width = rays->pixel_width();
  }
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
  const CameraRays* rays = passes.fine.factor > 1 ? held_->pixel_rays.get() : held_->rays.get();
  const CameraPose pose = pose_in(frame);
  out.resize(objects.width_px(), objects.height_px());
  return sum_over_rows(objects.height_px(), [&](int begin, int end) {
    std::vector<std::uint16_t> numbers(static_cast<std::size_t>(objects.width_px()));
    std::vector<std::uint16_t> mirrored(mirrors(passes.mirrored.empty()) ? numbers.size() : 0);
    PassChecks checks;
    Row row;
    row.pose = &pose;
    row.later_h = later_h(frame);
    row.surface = numbers;
    for (int y = begin; y < end; ++y) {
      const auto materials = has_materials ? passes.material_index.row(y) : std::span<const std::uint16_t>();
      map_.number(objects.row(y), materials, numbers);
      begin_row(passes, rays, y, row);
      begin_mirrored(passes.mirrored, y, mirrored, row);
      checks += check_row(row);
      row.radiance_w_m2_sr = out.row(y);
      for (const RowTerm& term : chain_) term(row);
    }
    return checks;
  });
}

/// A line of fine samples as input of the terms, in memory that the next line reuses.
struct SceneRadiance::FineLine {
  void begin(const FineSamples& fine, int y, int line, const CameraRays* rays, const PassNeeds& needs);
  void begin_mirrored(const Mirrored<SampleList>& mirrored, const SurfaceMap& map);

  std::vector<std::uint16_t> numbers;
  std::vector<std::uint16_t> mirrored_numbers;
  std::vector<float> radiance_w_m2_sr;
  std::vector<float> ray_x;
  std::vector<float> ray_y;
  std::vector<float> ray_length;
  std::size_t first = 0;  ///< of its samples
  std::size_t count = 0;
  Row row;
};

void SceneRadiance::FineLine::begin(const FineSamples& fine, int y, int line, const CameraRays* rays,
                                    const PassNeeds& needs) {
  const auto side = static_cast<std::size_t>(fine.factor);
  first = fine.line_begin(y, line);
  count = side * fine.pixels_in(y);
  numbers.resize(count);
  radiance_w_m2_sr.resize(count);
  row.surface = numbers;
  row.radiance_w_m2_sr = radiance_w_m2_sr;
  if (needs.depth) row.depth_m = std::span(fine.depth_m).subspan(first, count);
  for (std::size_t axis = 0; needs.normals && axis < 3; ++axis)
    row.normal[axis] = std::span(fine.normal[axis]).subspan(first, count);
  if (rays == nullptr) return;
  const int fine_y = y * fine.factor + line;
  const std::span<const float> xs = rays->x().row(fine_y);
  const std::span<const float> ys = rays->y().row(fine_y);
  const std::span<const float> lengths = rays->length().row(fine_y);
  for (auto* rows : {&ray_x, &ray_y, &ray_length}) rows->resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t fine_x =
        fine.x_px[fine.row_begin[static_cast<std::size_t>(y)] + k / side] * side + k % side;
    ray_x[k] = xs[fine_x];
    ray_y[k] = ys[fine_x];
    ray_length[k] = lengths[fine_x];
  }
  row.ray_x = ray_x;
  row.ray_y = ray_y;
  row.ray_length = ray_length;
  row.sample_width = rays->pixel_width();
}

void SceneRadiance::FineLine::begin_mirrored(const Mirrored<SampleList>& mirrored, const SurfaceMap& map) {
  mirrored_numbers.resize(count);
  map.number(std::span(mirrored.object_index).subspan(first, count),
             std::span(mirrored.material_index).subspan(first, count), mirrored_numbers);
  row.mirrored_surface = mirrored_numbers;
  row.mirrored_depth_m = std::span(mirrored.depth_m).subspan(first, count);
  for (std::size_t axis = 0; axis < 3; ++axis)
    row.mirrored_normal[axis] = std::span(mirrored.normal[axis]).subspan(first, count);
}

PassChecks SceneRadiance::refine(const FineSamples& fine, const ManifestFrame& frame, Plane<float>& out,
                                 SubpixelDetail* detail) const {
  const CameraPose pose = pose_in(frame);
  return sum_over_rows(out.height_px(), [&](int begin, int end) {
    PassChecks checks;
    FineLine line;
    line.row.pose = &pose;
    line.row.later_h = later_h(frame);
    QuarterSums sums(fine.factor);
    for (int y = begin; y < end; ++y) {
      sums.begin(fine.pixels_in(y));
      for (int k = 0; k < fine.factor && fine.pixels_in(y) > 0; ++k) {
        checks += radiance_of(fine, y, k, line);
        sums.add(k, std::span<const float>(line.radiance_w_m2_sr).first(line.count));
      }
      const std::size_t first = fine.row_begin[static_cast<std::size_t>(y)];
      for (std::size_t i = 0; i < fine.pixels_in(y); ++i) {
        const int x = fine.x_px[first + i];
        out.at(x, y) = sums.mean(i);
        if (detail != nullptr) set_detail(sums.quarters(i), x, y, *detail);
      }
    }
    return checks;
  });
}

/// For a line of samples.
PassChecks SceneRadiance::radiance_of(const FineSamples& fine, int y, int number, FineLine& line) const {
  const std::span materials(fine.material_index);
  line.begin(fine, y, number, held_->rays.get(), needs_);
  map_.number(std::span(fine.object_index).subspan(line.first, line.count),
              materials.empty() ? materials : materials.subspan(line.first, line.count), line.numbers);
  if (mirrors(fine.mirrored.empty())) line.begin_mirrored(fine.mirrored, map_);
  const PassChecks checks = check_row(line.row);
  for (const RowTerm& term : chain_) term(line.row);
  return checks;
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
