#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "heat/body/body_heat.h"
#include "heat/body/skin.h"
#include "heat/body/vehicle_heat.h"
#include "imaging/surfaces.h"
#include "scene/manifest.h"
#include "scene/material.h"
#include "scene/weather.h"

namespace thermal {

/// State of an actor or camp fire that sets its temperatures apart from others of its species.
struct ActorState {
  Activity activity = Activity::standing;
  double dress = 0.5;  ///< of people, 0 (light clothes) to 1: the middle of one of four equal parts
  VehicleState vehicle = {};
  double since_bath_s = std::numeric_limits<double>::infinity();
  FireState fire = {};  ///< of a camp fire instead of an actor

  [[nodiscard]] bool operator==(const ActorState&) const = default;
};

/// States of a clip's actors, by class of actors.
struct ActorStates {
  ActorClasses classes;
  std::vector<ActorState> states;

  [[nodiscard]] const ActorState& of_object(std::uint16_t index) const {
    return states.at(classes.of_object.at(index));
  }
};

/// The state at a later or earlier time.
[[nodiscard]] ActorState later_by(ActorState state, double later_s) noexcept;

/// The state of a fire some time after time 0 of the scene.
[[nodiscard]] FireState fire_state(const FirePlace& placed_fire, double later_s);

/// Midpoint of a clip's frames in the time of its scene [s]; 0 without frames.
[[nodiscard]] double middle_s(const Manifest& manifest);

/// Time since a parked vehicle stopped, if unknown [s]: 120 to 43200, uniform in its logarithm, in 16 steps. An
/// estimate: some have just arrived, some stand since the evening before. @param uniform  of the vehicle, 0 to 1
[[nodiscard]] double drawn_stop_s(double uniform) noexcept;

/// States at the midpoint of a clip. Actors walk or drive if they are ever more than a decimetre from their first
/// position. The manifest's states of engines and baths are those at time 0 of the scene; vehicles without one drive if
/// they move; otherwise they stopped at the weather's time, or at drawn_stop_s(). Clothes and stops are drawn from
/// (seed, object index), the same in all clips. DataError if there are more than 250 different states.
[[nodiscard]] ActorStates states_of_actors(const Manifest& manifest, const MaterialLibrary& materials,
                                           const Weather& weather, std::uint32_t seed);

}  // namespace thermal
