#include "io/material_files.h"

#include <fmt/format.h>

#include "base/error.h"
#include "io/json_file.h"
#include "io/json_schema.h"

namespace thermal {

MaterialLibrary read_materials(const Path& home) {
  const Json schema = read_json(home / "configs" / "schema" / "material.schema.json");
  MaterialLibrary library;
  for (const auto& entry : std::filesystem::directory_iterator(home / "assets" / "materials")) {
    const Path& file = entry.path();
    if (file.extension() != ".json") continue;
    Json document = read_json(file);
    const std::vector<std::string> faults = check_and_fill(document, schema);
    if (!faults.empty()) throw ConfigError(fmt::format("{}: {}", file.string(), faults.front()));
    library.add({.name = file.stem().string(),
                 .emissivity = document["emissivity"],
                 .winter_k = document["winter_k"],
                 .summer_k = document["summer_k"],
                 .in_table_1 = document["in_table_1"]});
  }
  return library;
}

}  // namespace thermal
