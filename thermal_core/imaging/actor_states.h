#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "heat/body/body_heat.h"
#include "heat/body/tissue.h"
#include "heat/body/vehicle_heat.h"
#include "imaging/surfaces.h"
#include "scene/manifest.h"
#include "scene/material.h"
#include "scene/weather.h"

namespace thermal {

/// How the temperatures of one actor differ from those of another of its species, or one camp fire from another.
struct ActorState {
  Activity activity = Activity::standing;
  double dress = 0.5;  ///< of people, 0 (thin clothes) to 1: the middle of one of four equal parts
  VehicleState vehicle = {};
  double since_bath_s = std::numeric_limits<double>::infinity();
  FireState fire = {};  ///< of a camp fire instead of an actor

  [[nodiscard]] bool operator==(const ActorState&) const = default;
};

/// The states of a clip's actors: one each class of actors, by its number.
struct ActorStates {
  ActorClasses classes;
  std::vector<ActorState> states;

  [[nodiscard]] const ActorState& of_object(std::uint16_t index) const {
    return states.at(classes.of_object.at(index));
  }
};

/// The state some time later, or earlier.
[[nodiscard]] ActorState later_by(ActorState state, double later_s) noexcept;

/// The state of a fire some time after time 0 of the scene.
[[nodiscard]] FireState fire_state(const FirePlace& place, double later_s);

/// Middle of a clip's frames in the time of its scene [s]; 0 without frames.
[[nodiscard]] double middle_s(const Manifest& manifest);

/// Time since a parked vehicle stopped, where nothing states it [s]: 120 to 43200, even in its logarithm, in 16 steps.
/// An estimate: some have just arrived, some stand since the evening before. @param uniform  of the vehicle, 0 to 1
[[nodiscard]] double drawn_stop_s(double uniform) noexcept;

/// The states in the middle of a clip. Actors walk or drive if they are ever more than a decimetre from their first
/// place. What the manifest states of an engine or a bath holds at time 0 of the scene; vehicles of which it states
/// nothing drive if they move, and have stopped as the weather says or else as drawn_stop_s() says. Clothes and stops
/// are drawn from (seed, object index), the same in all clips. DataError if there are more than 250 different states.
[[nodiscard]] ActorStates states_of_actors(const Manifest& manifest, const MaterialLibrary& materials,
                                           const Weather& weather, std::uint32_t seed);

}  // namespace thermal
