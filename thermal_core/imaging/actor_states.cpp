#include "imaging/actor_states.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "base/error.h"
#include "base/rng.h"

namespace thermal {
namespace {

constexpr std::uint32_t kDressStream = 0x0D2E55;
constexpr std::uint32_t kStopStream = 0x57095;
constexpr std::size_t kMostStates = 250;  // a class is one byte

/// Indices of actors that move.
std::map<std::uint16_t, bool> movements(const Manifest& manifest) {
  constexpr double kStillM = 0.1;
  std::map<std::uint16_t, std::array<double, 3>> first;
  std::map<std::uint16_t, bool> moves;
  for (const ManifestFrame& frame : manifest.frames) {
    for (const ActorPose& actor : frame.actors) {
      const auto& start = first.emplace(actor.index, actor.position_m).first->second;
      const double moved_m = std::hypot(actor.position_m[0] - start[0], actor.position_m[1] - start[1]);
      moves[actor.index] = moves[actor.index] || moved_m > kStillM;
    }
  }
  return moves;
}

double uniform_of(std::uint16_t index, std::uint32_t seed, std::uint32_t stream) {
  constexpr double kPerWord = 0x1p-32;
  return Philox4x32::generate({index, 0, 0, stream}, {seed, 0})[0] * kPerWord;
}

/// Middle of that of `steps` equal parts of [0, 1] which holds a uniform number.
double in_steps(double uniform, int steps) {
  return (std::min(std::floor(uniform * steps), steps - 1.0) + 0.5) / steps;
}

double dress_of(std::uint16_t index, std::uint32_t seed) {
  constexpr int kDresses = 4;
  const auto words = Philox4x32::generate({index, 0, 0, kDressStream}, {seed, 0});
  return (words[0] % kDresses + 0.5) / kDresses;
}

template <typename Kind>
bool has(const Material& material) {
  const auto is_kind = [](const std::optional<BodyHeat>& heat) {
    return heat && std::holds_alternative<Kind>(*heat);
  };
  return is_kind(material.body_heat) || std::ranges::any_of(material.parts, [&](const auto& part) {
           return is_kind(part.second.body_heat);
         });
}

VehicleState vehicle_of(const ManifestObject& object, bool moves, double later_s, const Weather& weather,
                        std::uint32_t seed) {
  constexpr double kWarmS = 3600;
  if (object.engine) {
    VehicleState given = *object.engine;
    given.since_s += later_s;
    return given;
  }
  if (moves) return {.engine = EngineState::driving, .since_s = kWarmS};
  return {.since_s = weather.vehicle_stopped_s ? *weather.vehicle_stopped_s
                                               : drawn_stop_s(uniform_of(object.index, seed, kStopStream))};
}

std::uint8_t number_of(const ActorState& state, std::vector<ActorState>& states) {
  const auto found = std::ranges::find(states, state);
  const auto number = static_cast<std::size_t>(found - states.begin());
  if (found == states.end()) states.push_back(state);
  if (states.size() > kMostStates)
    throw DataError(fault("objects", "more", "",
                          fmt::format("at most {} different states of engines and baths", kMostStates)));
  return static_cast<std::uint8_t>(number);
}

ActorState state_of(const ManifestObject& object, const Material& material, bool moves, double later_s,
                    const Weather& weather, std::uint32_t seed) {
  ActorState state = {.activity = moves ? Activity::walking : Activity::standing};
  if (has<Clothing>(material)) state.dress = dress_of(object.index, seed);
  if (has<EngineWarmed>(material)) state.vehicle = vehicle_of(object, moves, later_s, weather, seed);
  if (object.wet_s) state.since_bath_s = *object.wet_s + later_s;
  return state;
}

}  // namespace

ActorState later_by(ActorState state, double later_s) noexcept {
  const auto move = [later_s](double& since_s) { since_s = std::max(0.0, since_s + later_s); };
  move(state.vehicle.since_s);
  move(state.since_bath_s);
  move(state.fire.burning ? state.fire.fire.burning_s : state.fire.since_s);
  return state;
}

FireState fire_state(const FirePlace& placed_fire, double later_s) {
  FireState state = {.fire = {.diameter_m = placed_fire.diameter_m}, .burning = placed_fire.burning};
  if (placed_fire.burning) {
    state.fire.burning_s = placed_fire.since_s + later_s;
  } else {
    state.since_s = placed_fire.since_s + later_s;
  }
  return state;
}

double middle_s(const Manifest& manifest) {
  if (manifest.frames.empty()) return 0;
  return 0.5 * (manifest.frames.front().time_s + manifest.frames.back().time_s);
}

double drawn_stop_s(double uniform) noexcept {
  constexpr double kShortestS = 120;
  constexpr double kLongestS = 43200;
  constexpr int kSteps = 16;
  return kShortestS * std::pow(kLongestS / kShortestS, in_steps(uniform, kSteps));
}

ActorStates states_of_actors(const Manifest& manifest, const MaterialLibrary& materials,
                             const Weather& weather, std::uint32_t seed) {
  const std::map<std::uint16_t, bool> movement = movements(manifest);
  const double later_s = middle_s(manifest);
  ActorStates all = {.classes = {.of_object = std::vector<std::uint8_t>(kIndexValues)}, .states = {{}}};
  for (const ManifestObject& object : manifest.objects) {
    ActorState state;
    if (object.fire) {
      state.fire = fire_state(*object.fire, later_s);
    } else if (object.object_class == ObjectClass::actor) {
      const Material& material =
          materials.find(object.material, fmt::format("object {}: material", object.name));
      const auto found = movement.find(object.index);
      state = state_of(object, material, found != movement.end() && found->second, later_s, weather, seed);
    } else {
      continue;
    }
    all.classes.of_object[object.index] = number_of(state, all.states);
  }
  all.classes.count = static_cast<std::uint8_t>(all.states.size());
  return all;
}

}  // namespace thermal
