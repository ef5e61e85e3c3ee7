#include "io/config/materials.h"

#include <array>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "base/text.h"
#include "io/config/spectra.h"
#include "io/json/schema.h"

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

namespace {

/// One of three states of moisture, or the one number for all of them.
double at_state(const Json& value, std::size_t state) { return value.is_array() ? value[state] : value; }

SurfaceProperties read_surface(const Json& json, std::size_t state) {
  return {.albedo = at_state(json["albedo"], state),
          .emissivity = at_state(json["broadband_emissivity"], state),
          .roughness_m = at_state(json["roughness_m"], state),
          .evaporation = at_state(json["evaporation"], state)};
}

std::optional<Subsoil> read_subsoil(const Json& ground) {
  if (!ground.contains("subsoil")) return std::nullopt;
  const Json& json = ground["subsoil"];
  return Subsoil{.depth_m = json["depth_m"],
                 .conductivity_w_m_k = json["conductivity_w_m_k"],
                 .heat_capacity_j_m3_k = json["heat_capacity_j_m3_k"]};
}

GroundProperties read_ground(const Json& json, std::size_t state) {
  return {.surface = read_surface(json, state),
          .conductivity_w_m_k = at_state(json["conductivity_w_m_k"], state),
          .heat_capacity_j_m3_k = at_state(json["heat_capacity_j_m3_k"], state),
          .thickness_m = json["thickness_m"],
          .subsoil = read_subsoil(json)};
}

CanopyProperties read_canopy(const Json& json, std::size_t state) {
  return {.leaf_area_index = at_state(json["leaf_area_index"], state),
          .albedo = at_state(json["albedo"], state),
          .emissivity = json["broadband_emissivity"],
          .leaf_width_m = at_state(json["leaf_width_m"], state),
          .height_m = json["height_m"],
          .leaf_conductance_m_s = at_state(json["leaf_conductance_m_s"], state),
          .heat_capacity_j_m2_k = at_state(json["heat_capacity_j_m2_k"], state)};
}

}  // namespace

MaterialHeat read_material_heat(const Json& json, const std::string& where) {
  std::vector<std::string> kinds;
  for (const char* kind : {"ground", "leaves", "slab"}) {
    if (json.contains(kind)) kinds.emplace_back(kind);
  }
  if (kinds.size() != 1)
    throw ConfigError(
        fault(where, kinds.empty() ? "nothing" : list_names(kinds), "", "one of ground, leaves and slab"));
  const Json& values = json[kinds.front()];
  const bool is_body = json["is_body"];
  if (kinds.front() == "ground")
    return GroundHeat{.states = {read_ground(values, 0), read_ground(values, 1), read_ground(values, 2)},
                      .is_body = is_body};
  if (kinds.front() == "leaves")
    return LeavesHeat{.states = {read_canopy(values, 0), read_canopy(values, 1), read_canopy(values, 2)},
                      .ground = values["ground"],
                      .is_cover = values["is_cover"],
                      .leaf_density_m2_m3 = values["leaf_density_m2_m3"]};
  return SlabHeat{.properties = {.surface = read_surface(values, 0),
                                 .heat_capacity_j_m2_k = values["heat_capacity_j_m2_k"],
                                 .behind_w_m2_k = values["behind_w_m2_k"]},
                  .is_body = is_body};
}

namespace {

AngularLaw read_law(const std::string& name) {
  if (name == "water") return AngularLaw::water;
  return name == "soil" ? AngularLaw::soil : AngularLaw::none;
}

std::optional<BodyHeat> read_heat(const Json& json, const std::string& where) {
  if (!json.contains("body_heat")) return std::nullopt;
  return read_body_heat(json["body_heat"], where + "body_heat");
}

std::optional<MaterialHeat> read_part_heat(const Json& json, const std::string& where) {
  if (!json.contains("heat")) return std::nullopt;
  if (json["heat"].contains("band_emissivity"))
    throw ConfigError(fault(where + ".heat.band_emissivity", brief(json["heat"]["band_emissivity"]), "",
                            "none, because parts have the emissivity of their material"));
  return read_material_heat(json["heat"], where + ".heat");
}

MaterialPart read_part(const Json& json, const std::string& where) {
  return {.excess_factor = json["excess_factor"],
          .offset_k = json["offset_k"],
          .cooling_excess_k = json["cooling_excess_k"],
          .cooling_time_s = json["cooling_time_s"],
          .body_heat = read_heat(json, where + "."),
          .heat = read_part_heat(json, where)};
}

Path spectrum_file(const std::string& text, const Path& material) {
  const auto name = RelativeName::of(text);
  if (!name) throw ConfigError(fault(material.string() + ": spectrum", brief(text), "", RelativeName::kRule));
  return material.parent_path() / name->text();
}

Material read_material(const Json& json, const Path& file) {
  Material material;
  material.name = file.stem().string();
  material.emissivity = json["emissivity"];
  material.measured_emissivity = material.emissivity;
  material.winter_k = json["winter_k"];
  material.summer_k = json["summer_k"];
  material.in_table_1 = json["in_table_1"];
  if (json.contains("spectrum")) material.spectrum = read_emissivity(spectrum_file(json["spectrum"], file));
  material.angular = read_law(json["angular"]);
  material.variation = {.stddev_k = json["variation"]["stddev_k"],
                        .correlation_length_m = json["variation"]["correlation_length_m"]};
  material.body_heat = read_heat(json, file.string() + ": ");
  for (const auto& [part, values] : json["parts"].items()) {
    material.parts[part] = read_part(values, fmt::format("{}: parts.{}", file.string(), part));
  }
  if (json.contains("heat")) {
    const Json& heat = json["heat"];
    material.heat = read_material_heat(heat, file.string() + ": heat");
    material.measured_emissivity = heat.value("band_emissivity", material.emissivity);
  }
  return material;
}

}  // namespace

MaterialLibrary read_materials(const Assets& assets) {
  const Json schema = assets.schema("material");
  MaterialLibrary library;
  for (const auto& entry : std::filesystem::directory_iterator(assets.folder("materials"))) {
    const Path& file = entry.path();
    if (file.extension() != ".json") continue;
    Json document = read_json(file);
    const std::vector<std::string> faults = check_and_fill(document, schema);
    if (!faults.empty()) throw ConfigError(fmt::format("{}: {}", file.string(), faults.front()));
    library.add(read_material(document, file));
  }
  return library;
}

}  // namespace thermal
