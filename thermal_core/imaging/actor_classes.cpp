#include "imaging/actor_classes.h"

#include <cmath>
#include <map>

#include "base/rng.h"

namespace thermal {
namespace {

constexpr std::uint32_t kDressStream = 0x0D2E55;

/// Indices of actors that are not always at one place.
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

int dress_of(std::uint16_t index, std::uint32_t seed) {
  const auto words = Philox4x32::generate({index, 0, 0, kDressStream}, {seed, 0});
  return static_cast<int>(words[0] % ActorClass::kDresses);
}

}  // namespace

ActorClass ActorClass::of(std::uint8_t number) noexcept {
  return {.moving = number >= kDresses, .dress = (number % kDresses + 0.5) / kDresses};
}

ActorClasses classes_of_actors(const Manifest& manifest, std::uint32_t seed) {
  const std::map<std::uint16_t, bool> moves = movements(manifest);
  ActorClasses classes = {.of_object = std::vector<std::uint8_t>(kLargestIndex + 1),
                          .count = ActorClass::kCount};
  for (const ManifestObject& object : manifest.objects) {
    if (object.object_class != ObjectClass::actor) continue;
    const auto found = moves.find(object.index);
    const bool moving = found != moves.end() && found->second;
    classes.of_object[object.index] =
        static_cast<std::uint8_t>(dress_of(object.index, seed) + (moving ? ActorClass::kDresses : 0));
  }
  return classes;
}

}  // namespace thermal
