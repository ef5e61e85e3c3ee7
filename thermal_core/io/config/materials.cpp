#include "io/config/materials.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "io/assets.h"
#include "io/config/body_heat.h"
#include "io/config/material_heat.h"
#include "io/config/spectra.h"
#include "io/json/file.h"
#include "io/json/schema.h"

namespace thermal {
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
