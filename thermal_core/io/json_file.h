#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "io/files.h"

namespace thermal {

/// JSON that keeps its keys in the order they came.
using Json = nlohmann::ordered_json;

/// ConfigError "NAME:LINE:COLUMN: not JSON: …" for text that is not JSON, or has a key twice in one object.
[[nodiscard]] Json parse_json(std::string_view text, const std::string& name);

/// The same for a file; IoError if it cannot be read.
[[nodiscard]] Json read_json(const Path& file);

/// Indented by two, newline at the end.
[[nodiscard]] std::string to_text(const Json& json);

/// Each place where two documents differ: "sensor.netd_mk is 40 here and 50 there".
[[nodiscard]] std::vector<std::string> differences(const Json& here, const Json& there);

}  // namespace thermal
