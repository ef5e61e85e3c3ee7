#include "io/config/body_heat.h"

#include <set>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

/// Takes the keys of one object, and reports those that were not taken.
class HeatKeys {
 public:
  HeatKeys(const Json& json, const std::string& where) : json_(json), where_(where) {}

  void take(const char* key, double& value) {
    if (const Json* given = find(key)) value = given->get<double>();
  }
  void take(const char* key, std::string& value) {
    if (const Json* given = find(key)) value = given->get<std::string>();
  }
  void take(const char* key, DrawnRange& value) {
    if (const Json* given = find(key)) value = {.low = (*given)[0], .high = (*given)[1]};
  }
  void finish(const std::string& kind) const {
    const std::vector<std::string> known(known_.begin(), known_.end());
    for (const auto& [key, value] : json_.items()) {
      if (known_.contains(key)) continue;
      throw ConfigError(
          fault(where_ + "." + key, value.dump(), "",
                fmt::format("no such key in heat of kind {}; its keys are {}", kind, list_names(known, 40))));
    }
  }

 private:
  const Json* find(const char* key) {
    known_.insert(key);
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }

  const Json& json_;
  const std::string& where_;
  std::set<std::string> known_ = {"kind", "source"};
};

void take_tissue(HeatKeys& keys, Tissue& tissue) {
  keys.take("core_k", tissue.core_k);
  keys.take("warm_tissue_m2_k_w", tissue.warm_m2_k_w);
  keys.take("cold_tissue_m2_k_w", tissue.cold_m2_k_w);
}

void take_radiation(HeatKeys& keys, BodySurface& surface) {
  keys.take("albedo", surface.albedo);
  keys.take("broadband_emissivity", surface.emissivity);
  keys.take("open_view", surface.open_view);
}

void take_surface(HeatKeys& keys, BodySurface& surface) {
  take_radiation(keys, surface);
  keys.take("diameter_m", surface.diameter_m);
  keys.take("wet", surface.wet);
}

void take_sheet(HeatKeys& keys, Sheet& sheet) {
  keys.take("albedo", sheet.surface.albedo);
  keys.take("broadband_emissivity", sheet.surface.emissivity);
  keys.take("behind_w_m2_k", sheet.behind_w_m2_k);
}

BodyHeat clothing(HeatKeys& keys) {
  Clothing clothing;
  keys.take("cold_clo", clothing.cold_clo);
  keys.take("warm_clo", clothing.warm_clo);
  take_tissue(keys, clothing.tissue);
  take_radiation(keys, clothing.surface);
  return clothing;
}

/// Of a person: the air moves past it as past clothes.
BodyHeat skin(HeatKeys& keys) {
  Coat skin;
  skin.surface = {.albedo = 0.35, .emissivity = 0.98, .open_view = 0.85};
  take_tissue(keys, skin.tissue);
  take_radiation(keys, skin.surface);
  return skin;
}

BodyHeat coat(HeatKeys& keys) {
  Coat coat;
  take_tissue(keys, coat.tissue);
  keys.take("coat_m2_k_w", coat.coat_m2_k_w);
  keys.take("wet_when_bathed", coat.wet_when_bathed);
  keys.take("drying_s", coat.drying_s);
  take_surface(keys, coat.surface);
  return coat;
}

BodyHeat cold_blooded(HeatKeys& keys) {
  ColdBlooded body;
  keys.take("above_k", body.above_k);
  keys.take("tissue_m2_k_w", body.tissue_m2_k_w);
  take_surface(keys, body.surface);
  return body;
}

BodyHeat unheated(HeatKeys& keys) {
  Unheated thing;
  take_surface(keys, thing.surface);
  return thing;
}

BodyHeat sheet(HeatKeys& keys) {
  Sheet sheet;
  take_sheet(keys, sheet);
  return sheet;
}

BodyHeat engine(HeatKeys& keys) {
  EngineWarmed part;
  take_sheet(keys, part.sheet);
  keys.take("driving_k", part.warmth.driving_k);
  keys.take("idling_k", part.warmth.idling_k);
  keys.take("parked_k", part.warmth.parked_k);
  keys.take("soak_s", part.warmth.soak_s);
  keys.take("cooling_s", part.warmth.cooling_s);
  keys.take("warming_s", part.warmth.warming_s);
  return part;
}

BodyHeat powered(HeatKeys& keys) {
  Powered part;
  take_sheet(keys, part.sheet);
  keys.take("excess_k", part.excess_k);
  return part;
}

BodyHeat fire_part(HeatKeys& keys) {
  std::string of = "ash";
  keys.take("of", of);
  if (of == "embers") return FirePart{FirePart::Of::embers};
  return FirePart{of == "flames" ? FirePart::Of::flames : FirePart::Of::ash};
}

BodyHeat read_kind(HeatKeys& keys, const std::string& kind) {
  if (kind == "clothing") return clothing(keys);
  if (kind == "skin") return skin(keys);
  if (kind == "coat") return coat(keys);
  if (kind == "cold_blooded") return cold_blooded(keys);
  if (kind == "unheated") return unheated(keys);
  if (kind == "sheet") return sheet(keys);
  if (kind == "engine") return engine(keys);
  if (kind == "powered") return powered(keys);
  if (kind == "fire") return fire_part(keys);
  return {};  // "air", the only other kind of the schema
}

}  // namespace

BodyHeat read_body_heat(const Json& json, const std::string& where) {
  const auto kind = json["kind"].get<std::string>();
  HeatKeys keys(json, where);
  BodyHeat heat = read_kind(keys, kind);
  keys.finish(kind);
  validate(heat, where);
  return heat;
}

}  // namespace thermal
