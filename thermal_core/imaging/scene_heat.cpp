#include "imaging/scene_heat.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "heat/body/body_heat.h"
#include "heat/body/fire.h"
#include "heat/body/warm_ground.h"
#include "heat/surface/heat_report.h"
#include "heat/surface/leaf_layer.h"
#include "heat/weather/sun_memory.h"

namespace thermal {
namespace {

const std::string kWholeBody;

/// Leaves without maps are seen in the middle of their crowns.
constexpr double kMiddleOfCrown = 0.6;

/// What a crown leaves of sky and sun to the wood below it: an estimate.
constexpr double kBelowCrown = 0.6;

/// The variation field has five octaves, each 0.6 times as strong as the one before. Those down to two cells of the maps
/// are part of the maps; the field adds the finer ones.
struct SplitVariation {
  double map_stddev_k = 0;
  double fine_stddev_k = 0;
  double fine_length_m = 1;
};

SplitVariation split(const TemperatureVariation& variation, double cell_m) {
  constexpr double kRoughness2 = 0.36;
  constexpr int kOctaves = 5;
  double all = 0;
  double fine = 0;
  double strength = 1;
  double length_m = variation.correlation_length_m;
  SplitVariation result;
  for (int octave = 0; octave < kOctaves; ++octave, strength *= kRoughness2, length_m /= 2) {
    all += strength;
    if (length_m >= 2 * cell_m) continue;
    if (fine == 0) result.fine_length_m = length_m;
    fine += strength;
  }
  result.map_stddev_k = variation.stddev_k * std::sqrt(1 - fine / all);
  result.fine_stddev_k = variation.stddev_k * std::sqrt(fine / all);
  return result;
}

std::vector<float> sunlit_cells(const GroundMaps& maps, const DayWeather& day, double solar_h) {
  const auto found = std::ranges::find(maps.sunlit, day.sun, &SunlitHours::path);
  if (found == maps.sunlit.end()) return {};
  const SunMemory memory = sun_memory(day, solar_h);
  // Cells share few patterns of hours; low and high half of a pattern are looked up.
  constexpr std::size_t kHalf = 12;
  std::vector<float> low(1U << kHalf);
  std::vector<float> high(1U << kHalf);
  for (std::uint32_t bits = 0; bits < low.size(); ++bits) {
    low[bits] = sunlit_share(memory, bits);
    high[bits] = sunlit_share(memory, bits << kHalf);
  }
  std::vector<float> share(found->hours.size());
  std::ranges::transform(found->hours, share.begin(), [&](std::uint32_t hours) {
    return low[hours & 0xFFFU] + high[hours >> kHalf & 0xFFFU];
  });
  return share;
}

/// Ground around a fire. What it took up while the fire burnt, it gives back as a bed does.
WarmSpot fireside(const FirePlace& place, double later_s, const Surroundings& around) {
  constexpr double kReachM = 12;
  constexpr std::size_t kSteps = 96;
  const FireState state = fire_state(place, later_s);
  const GroundProperties ground;
  const double left =
      state.burning ? 1 : bed_share_left(state.fire.burning_s, std::max(1.0, state.since_s), WarmedGround());
  WarmSpot spot = {.x_m = place.place_m[0], .y_m = place.place_m[1], .reach = kReachM, .excess_k = {}};
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const double distance_m = kReachM * static_cast<double>(step) / kSteps;
    const double warm_k = fireside_ground_k(state.fire, around, ground, around.ground_k, distance_m);
    spot.excess_k.push_back(static_cast<float>(left * (warm_k - around.ground_k)));
  }
  const float last_k = spot.excess_k.back();  // without a step at its end
  for (float& excess_k : spot.excess_k) excess_k = std::max(0.0F, excess_k - last_k);
  return spot;
}

/// Even below the body, and vague at its rim (estimate); none where the ground is warmer than an animal.
WarmSpot warm_bed(const WarmBed& bed, double later_s, double ground_k) {
  constexpr double kReach = 1.1;
  constexpr double kEven = 0.85;
  constexpr std::size_t kSteps = 44;
  const WarmedGround ground;
  const double excess_k = std::max(0.0, bed_excess_k({.time_s = bed.lain_s}, ground, ground_k)) *
                          bed_share_left(bed.lain_s, bed.left_s + later_s, ground);
  WarmSpot spot = {.x_m = bed.place_m[0],
                   .y_m = bed.place_m[1],
                   .heading_rad = bed.heading_rad,
                   .half_length_m = bed.half_m[0],
                   .half_width_m = bed.half_m[1],
                   .reach = kReach,
                   .excess_k = {}};
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const double out = kReach * static_cast<double>(step) / kSteps;
    const double share = std::clamp((kReach - out) / (kReach - kEven), 0.0, 1.0);
    spot.excess_k.push_back(static_cast<float>(share * excess_k));
  }
  return spot;
}

/// Finds the temperatures of surfaces, one by one.
class Builder {
 public:
  Builder(const std::vector<ActorState>& states, const HeatSettings& settings, const Weather& weather,
          const SceneHeatTerms& terms)
      : states_(states),
        settings_(settings),
        weather_(weather),
        moment_(settings.day->at(weather.solar_h)),
        terms_(terms) {}

  void add(const Surface& surface) {
    // What no actor's state concerns is the same in all classes.
    const bool concerned =
        surface.actor_class == 0 || surface.material->body_heat_of(surface.part) != nullptr;
    heat_.surfaces.push_back(concerned ? heat_of(surface) : heat_.surfaces[heat_.surfaces.size() % first_]);
    if (surface.actor_class == 0) first_ = heat_.surfaces.size();
  }

  SceneHeat finish(const Manifest& manifest, std::uint32_t seed) {
    heat_.spots = WarmSpots(warm_spots(manifest));
    if (settings_.ground == nullptr) return std::move(heat_);
    const GroundMaps& maps = *settings_.ground;
    heat_.ground = std::make_unique<GroundTemperatures>(
        maps, window_of(maps, manifest), sunlit_cells(maps, settings_.day->weather(), weather_.solar_h),
        moment_.ground_moisture, covers_, seed);
    return std::move(heat_);
  }

 private:
  [[nodiscard]] HeatedSurface heat_of(const Surface& surface) {
    HeatedSurface heated;
    const Material& material = *surface.material;
    set_variation(material, heated);
    const std::string& part = terms_.parts || is_fire(material) ? surface.part : kWholeBody;
    if (const BodyHeat* body = material.body_heat_of(part)) {
      set_body(*body, moment_of(states_.at(surface.actor_class)), heated);
    } else if (const MaterialHeat* heat = material.heat_of(surface.part)) {
      const std::string name = material.heat_name(surface.part);
      const MaterialMoment& by_place = moment_.materials.at(name);
      heated.rate_k_h = static_cast<float>(settings_.day->rate_k_h(name, weather_.solar_h));
      if (heat != material.heat_of("") && is_crown(material)) {
        set_oriented(by_place.orientation(below_crown()), heated);
      } else {
        std::visit([&](const auto& kind) { set(kind, material, by_place, heated); }, *heat);
      }
    } else {
      heated.temperature_k = static_cast<float>(material.part_temperature_k(part, weather_));
    }
    return heated;
  }

  [[nodiscard]] SurfacePlace open_place() const { return {.moisture = moment_.ground_moisture}; }

  [[nodiscard]] std::vector<WarmSpot> warm_spots(const Manifest& manifest) const {
    const Surroundings around = {.forcing = moment_.forcing, .ground_k = moment_.ground_k};
    std::vector<WarmSpot> spots;
    for (const ManifestObject& object : manifest.objects) {
      if (object.fire) spots.push_back(fireside(*object.fire, middle_s(manifest), around));
    }
    for (const WarmBed& bed : manifest.beds)
      spots.push_back(warm_bed(bed, middle_s(manifest), moment_.ground_k));
    return spots;
  }

  [[nodiscard]] SurfacePlace below_crown() const {
    return {.sky_view = kBelowCrown, .sunlit = kBelowCrown, .moisture = moment_.ground_moisture};
  }

  static bool is_fire(const Material& material) {
    return material.body_heat && std::holds_alternative<FirePart>(*material.body_heat);
  }

  static bool is_crown(const Material& material) {
    const auto* leaves = material.heat ? std::get_if<LeavesHeat>(&*material.heat) : nullptr;
    return leaves != nullptr && !leaves->is_cover;
  }

  void set_variation(const Material& material, HeatedSurface& heated) const {
    if (!terms_.variation) return;
    heated.variation_stddev_k = static_cast<float>(material.variation.stddev_k);
    heated.per_correlation_length = static_cast<float>(1 / material.variation.correlation_length_m);
  }

  void set(const GroundHeat& heat, const Material& material, const MaterialMoment& by_place,
           HeatedSurface& heated) {
    heat.is_body ? set_oriented(by_place, heated) : set_cover(material, by_place, heated);
  }

  void set(const LeavesHeat& heat, const Material& material, const MaterialMoment& by_place,
           HeatedSurface& heated) {
    if (heat.is_cover) return set_cover(material, by_place, heated);
    SurfacePlace place = open_place();
    place.sky_view = kMiddleOfCrown;
    heated.temperature_k = static_cast<float>(by_place.temperature_k(place));
    if (settings_.ground == nullptr) return;
    heated.kind = HeatedSurface::Kind::crown;
    for (std::size_t node = 0; node < HeatedSurface::kDepths; ++node) {
      constexpr double kNodeM = 0.25;
      place.sky_view = diffuse_through_leaves(heat.leaf_density_m2_m3 * kNodeM * static_cast<double>(node));
      heated.by_depth_k[node] = static_cast<float>(by_place.temperature_k(place));
    }
  }

  void set(const SlabHeat& heat, const Material&, const MaterialMoment& by_place,
           HeatedSurface& heated) const {
    if (heat.is_body) return set_oriented(by_place, heated);
    heated.temperature_k = static_cast<float>(by_place.temperature_k(open_place()));
  }

  [[nodiscard]] BodyMoment moment_of(const ActorState& actor) const {
    BodyMoment moment = {.around = {.forcing = moment_.forcing, .ground_k = moment_.ground_k}};
    moment.activity = actor.activity;
    moment.dress = actor.dress;
    moment.vehicle = actor.vehicle;
    moment.since_bath_s = actor.since_bath_s;
    moment.fire = actor.fire;
    if (const auto water = moment_.materials.find("water"); water != moment_.materials.end())
      moment.refuge_k = water->second.temperature_k(open_place());
    return moment;
  }

  void set_body(const BodyHeat& body, const BodyMoment& moment, HeatedSurface& heated) const {
    static const OrientationFit kFit = OrientationFit::of_bodies();
    std::vector<double> values_k;
    for (const EastNorthUp& direction : kFit.directions())
      values_k.push_back(part_temperature_k(body, moment, direction));
    set_oriented(kFit.fit(values_k, moment_.sun), heated);
    heated.temperature_k = static_cast<float>(part_temperature_k(body, moment, 0.0));
  }

  void set_oriented(const MaterialMoment& by_place, HeatedSurface& heated) const {
    set_oriented(by_place.orientation(open_place()), heated);
  }

  void set_oriented(const Orientation& orientation, HeatedSurface& heated) const {
    heated.temperature_k = static_cast<float>(orientation.at({0, 0, 1}));
    if (!terms_.normals) return;
    heated.kind = HeatedSurface::Kind::oriented;
    const auto rounded = [](double value) { return static_cast<float>(value); };
    std::ranges::transform(orientation.coefficients, heated.by_normal.begin(), rounded);
    std::ranges::transform(orientation.sun, heated.sun.begin(), rounded);
  }

  void set_cover(const Material& material, const MaterialMoment& by_place, HeatedSurface& heated) {
    set_oriented(by_place, heated);
    heated.steepest = 0.77F;
    if (settings_.ground == nullptr) return;
    heated.kind = HeatedSurface::Kind::cover;
    heated.cover = static_cast<std::int32_t>(covers_.size());
    const GroundMaps& maps = *settings_.ground;
    const SplitVariation variation = split(terms_.variation ? material.variation : TemperatureVariation{},
                                           maps.size_m / static_cast<double>(maps.cells));
    covers_.push_back({.heat = &by_place,
                       .stddev_k = variation.map_stddev_k,
                       .correlation_length_m = material.variation.correlation_length_m});
    heated.variation_stddev_k = static_cast<float>(variation.fine_stddev_k);
    heated.per_correlation_length = static_cast<float>(1 / variation.fine_length_m);
  }

  const std::vector<ActorState>& states_;
  const HeatSettings& settings_;
  const Weather& weather_;
  HeatOfMoment moment_;
  SceneHeatTerms terms_;
  std::vector<GroundTemperatures::Cover> covers_;
  SceneHeat heat_;
  std::size_t first_ = 0;  ///< how many surfaces are of the first class
};

}  // namespace

SceneHeat heat_of_scene(const std::vector<Surface>& surfaces, const std::vector<ActorState>& states,
                        const HeatSettings& settings, const Weather& weather, const Manifest& manifest,
                        const SceneHeatTerms& terms, std::uint32_t seed) {
  Builder builder(states, settings, weather, terms);
  for (const Surface& surface : surfaces) builder.add(surface);
  return builder.finish(manifest, seed);
}

std::map<std::string, std::map<std::string, double>> open_temperatures_k(
    const std::vector<const Material*>& materials, const MaterialLibrary& library, const Weather& weather) {
  std::map<std::string, MaterialHeat> heat;
  for (const auto& entry : heat_of_materials(library)) {
    const std::string& name = entry.first;
    const bool wanted =
        std::ranges::any_of(materials, [&](const Material* material) { return material->name == name; });
    if (wanted || std::holds_alternative<GroundHeat>(entry.second)) heat.insert(entry);
  }
  std::map<std::string, std::map<std::string, double>> temperatures;
  for (const HeatCurve& curve : open_curves(weather.day, heat))
    temperatures[curve.material][""] = curve.day.at_k(weather.solar_h);
  const auto soil = temperatures.find("soil");
  BodyMoment moment = {
      .around = {.forcing = forcing_at(weather.day, weather.solar_h),
                 .ground_k = soil == temperatures.end() ? weather.air.temperature_k : soil->second.at("")}};
  moment.vehicle.since_s = weather.vehicle_stopped_s.value_or(drawn_stop_s(0.5));
  for (const Material* material : materials) {
    if (const BodyHeat* whole = material->body_heat_of(""))
      temperatures[material->name][""] = part_temperature_k(*whole, moment, 0.0);
    for (const auto& [part, values] : material->parts) {
      if (const BodyHeat* body = material->body_heat_of(part))
        temperatures[material->name][part] = part_temperature_k(*body, moment, 0.0);
    }
  }
  return temperatures;
}

std::map<std::string, MaterialHeat> heat_of_materials(const MaterialLibrary& materials) {
  std::map<std::string, MaterialHeat> heat;
  for (const auto& [name, material] : materials.all()) {
    if (material.heat) heat.emplace(name, *material.heat);
    for (const auto& [part, values] : material.parts) {
      if (values.heat) heat.emplace(material.heat_name(part), *values.heat);
    }
  }
  return heat;
}

}  // namespace thermal
