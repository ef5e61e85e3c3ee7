#pragma once

#include <cstdint>

#include "imaging/surfaces.h"
#include "scene/manifest.h"

namespace thermal {

/// What tells the temperatures of one actor from those of another of its species.
struct ActorClass {
  static constexpr int kDresses = 4;
  static constexpr std::uint8_t kCount = 2 * kDresses;

  bool moving = false;  ///< walks or drives in this clip
  double dress = 0.5;   ///< of people, 0 (thin clothes) to 1: the middle of one of kDresses equal parts

  /// The class of this number, below kCount.
  [[nodiscard]] static ActorClass of(std::uint8_t number) noexcept;
};

/// The classes of a clip's actors: moving if they are ever more than a decimetre from their first place,
/// dressed by a random number of (seed, object index), the same in all clips.
[[nodiscard]] ActorClasses classes_of_actors(const Manifest& manifest, std::uint32_t seed);

}  // namespace thermal
