#include "imaging/heated_surfaces.h"

#include <algorithm>
#include <set>
#include <string>

#include "heat/body/body_heat.h"
#include "heat/surface/surface_balance.h"
#include "imaging/ground/mixture.h"

namespace thermal {
namespace {

const std::string kWholeBody;

/// Share of sky and sun that a crown leaves to the wood below it: an estimate.
constexpr double kBelowCrown = 0.6;

/// Largest horizontal part of the normals of ground: 50 deg.
constexpr float kSteepestGround = 0.77F;

/// The material that animals bathe in.
constexpr const char* kBath = "water";

bool is_fire(const Material& material) {
  return material.body_heat && std::holds_alternative<FirePart>(*material.body_heat);
}

/// Materials whose tables a scene needs, including what animals bathe in, which may not be visible.
std::set<std::string> heated_materials(const std::vector<Surface>& surfaces, const HeatSettings& settings) {
  std::set<std::string> names = {kBath};
  for (const Surface& surface : surfaces)
    if (surface.material->heat_of(surface.part) != nullptr)
      names.insert(surface.material->heat_name(surface.part));
  if (settings.ground)
    for (const std::string& name : ground_part_names(settings.ground->covers)) names.insert(name);
  return names;
}

}  // namespace

bool is_crown(const Material& material) {
  const auto* leaves = material.heat ? std::get_if<LeavesHeat>(&*material.heat) : nullptr;
  return leaves != nullptr && !leaves->is_cover;
}

HeatedSurfaces::HeatedSurfaces(const std::vector<Surface>& surfaces, const std::vector<ActorState>& states,
                               const HeatSettings& settings, const Weather& weather, double later_s,
                               const SceneHeatTerms& terms)
    : states_(states),
      settings_(settings),
      weather_(weather),
      later_s_(later_s),
      terms_(terms),
      moment_(settings.day->at(weather.solar_h + later_s / 3600, heated_materials(surfaces, settings))) {
  std::size_t of_first_class = 1;
  for (const Surface& surface : surfaces) {
    // Surfaces that do not depend on an actor's state are the same in all classes.
    const bool concerned =
        surface.actor_class == 0 || surface.material->body_heat_of(surface.part) != nullptr;
    surfaces_.push_back(concerned ? heat_of(surface) : surfaces_[surfaces_.size() % of_first_class]);
    if (surface.actor_class == 0) of_first_class = surfaces_.size();
  }
}

HeatedSurface HeatedSurfaces::heat_of(const Surface& surface) {
  HeatedSurface heated;
  const Material& material = *surface.material;
  if (terms_.variation) {
    heated.variation_stddev_k = static_cast<float>(material.variation.stddev_k);
    heated.per_correlation_length = static_cast<float>(1 / material.variation.correlation_length_m);
  }
  const std::string& part = terms_.parts || is_fire(material) ? surface.part : kWholeBody;
  if (const BodyHeat* body = material.body_heat_of(part)) {
    set_body(*body, moment_of(later_by(states_.at(surface.actor_class), later_s_)), heated);
  } else if (const MaterialHeat* heat = material.heat_of(surface.part)) {
    const MaterialMoment& by_exposure = moment_.materials.at(material.heat_name(surface.part));
    if (heat != material.heat_of("") && is_crown(material)) {
      set_oriented(by_exposure.orientation(
                       {.sky_view = kBelowCrown, .sunlit = kBelowCrown, .moisture = moment_.ground_moisture}),
                   heated);
    } else {
      std::visit([&](const auto& kind) { set(kind, by_exposure, heated); }, *heat);
    }
  } else {
    heated.middle.temperature_k = static_cast<float>(material.part_temperature_k(part, weather_));
  }
  return heated;
}

SurfaceExposure HeatedSurfaces::open_exposure() const { return {.moisture = moment_.ground_moisture}; }

void HeatedSurfaces::set(const GroundHeat& heat, const MaterialMoment& by_exposure, HeatedSurface& heated) {
  if (!heat.is_body) return set_cover(by_exposure, heated);
  set_oriented(by_exposure.orientation(open_exposure()), heated);
}

void HeatedSurfaces::set(const LeavesHeat& heat, const MaterialMoment& by_exposure, HeatedSurface& heated) {
  if (heat.is_cover) return set_cover(by_exposure, heated);
  SurfaceExposure exposure = open_exposure();
  exposure.sky_view = kMiddleOfCrown;
  heated.middle.temperature_k = static_cast<float>(by_exposure.temperature_k(exposure));
  if (!terms_.place) return;
  heated.kind = HeatedSurface::Kind::crown;
  for (std::size_t node = 0; node < SurfaceWarmth::kDepths; ++node) {
    const double depth_m = kCrownStepM * static_cast<double>(node);
    exposure.sky_view = diffuse_through_leaves(heat.leaf_density_m2_m3 * depth_m);
    heated.middle.by_depth_k[node] = static_cast<float>(by_exposure.temperature_k(exposure));
  }
}

void HeatedSurfaces::set(const SlabHeat& heat, const MaterialMoment& by_exposure, HeatedSurface& heated) {
  if (heat.is_body) return set_oriented(by_exposure.orientation(open_exposure()), heated);
  SurfaceExposure exposure = open_exposure();
  heated.middle.temperature_k = static_cast<float>(by_exposure.temperature_k(exposure));
  if (!terms_.place) return;
  heated.kind = HeatedSurface::Kind::water;
  for (std::size_t node = 0; node < SurfaceWarmth::kDepths; ++node) {
    exposure.depth_m = kWaterStepM * static_cast<double>(node);
    heated.middle.by_depth_k[node] = static_cast<float>(by_exposure.temperature_k(exposure));
  }
}

BodyMoment HeatedSurfaces::moment_of(const ActorState& actor) const {
  BodyMoment moment = {.around = {.forcing = moment_.forcing, .ground_k = moment_.ground_k}};
  moment.activity = actor.activity;
  moment.dress = actor.dress;
  moment.vehicle = actor.vehicle;
  moment.since_bath_s = actor.since_bath_s;
  moment.fire = actor.fire;
  if (const auto water = moment_.materials.find(kBath); water != moment_.materials.end())
    moment.refuge_k = water->second.temperature_k(open_exposure());
  return moment;
}

void HeatedSurfaces::set_body(const BodyHeat& body, const BodyMoment& moment, HeatedSurface& heated) const {
  static const OrientationFit kFit = OrientationFit::of_bodies();
  std::vector<double> values_k;
  for (const EastNorthUp& direction : kFit.directions())
    values_k.push_back(part_temperature_k(body, moment, direction));
  set_oriented(kFit.fit(values_k, moment_.sun), heated);
  heated.middle.temperature_k = static_cast<float>(part_temperature_k(body, moment, 0.0));
}

void HeatedSurfaces::set_oriented(const Orientation& orientation, HeatedSurface& heated) const {
  SurfaceWarmth& warmth = heated.middle;
  warmth.temperature_k = static_cast<float>(orientation.at({0, 0, 1}));
  if (!terms_.facing) return;
  heated.kind = HeatedSurface::Kind::oriented;
  const auto rounded = [](double value) { return static_cast<float>(value); };
  std::ranges::transform(orientation.coefficients, warmth.by_normal.begin(), rounded);
  std::ranges::transform(orientation.sun, warmth.sun.begin(), rounded);
}

void HeatedSurfaces::set_cover(const MaterialMoment& by_exposure, HeatedSurface& heated) {
  set_oriented(by_exposure.orientation(open_exposure()), heated);
  heated.steepest = kSteepestGround;
  if (!terms_.place) return;
  heated.kind = HeatedSurface::Kind::ground;
  heated.variation_stddev_k = 0;  // the ground's mixture has its own variation
}

}  // namespace thermal
