#include "dataset/physics.h"

namespace thermal {

std::optional<PhysicsSettings> physics_of(const Config& config, const ClipConfig& clip, const Terms& terms) {
  if (!config.physical) return std::nullopt;
  return PhysicsSettings{.terms = terms,
                         .weather = weather_of(config, clip.season),
                         .response = config.sensor.response,
                         .seed = config.seed};
}

Json to_json(const Budget& budget) {
  Json terms = Json::array();
  for (const TermEffect& effect : budget.effects) {
    terms.push_back({{"term", effect.name},
                     {"choice", choice_name(effect.choice)},
                     {"spread_mk", 1e3 * effect.spread_k},
                     {"actor_shift_mk", 1e3 * effect.actor_shift_k},
                     {"kept", effect.kept}});
    if (!effect.impossible.empty()) terms.back()["impossible"] = effect.impossible;
  }
  return {{"terms", std::move(terms)}, {"dropped_mk", 1e3 * budget.dropped_k}};
}

}  // namespace thermal
