#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/files.h"

namespace thermal {

/// JSON that keeps its keys in the order they came.
using Json = nlohmann::ordered_json;

/// ConfigError "NAME:LINE:COLUMN: not JSON: …" for text that is not JSON, has a key twice in one object, or lists and
/// objects more than 64 deep in each other.
[[nodiscard]] Json parse_json(std::string_view text, const std::string& name);

/// The same for a file; IoError if it cannot be read.
[[nodiscard]] Json read_json(const Path& file);

/// What is done with an element of a long array: the array's key in the document, empty where the document itself
/// is the array, and the element's place.
using TakeElement = std::function<void(const std::string& array, std::size_t place, const Json& element)>;

/// A document whose bulk is in arrays at its top: each element of each goes to `take` and is forgotten, so that
/// memory is that of the text and not of its tree, which takes ten times as much. Returns the rest, arrays empty.
/// Faults as of parse_json(); those of `take` pass through.
[[nodiscard]] Json parse_json_elements(std::string_view text, const std::string& name,
                                       const TakeElement& take);

/// The same for a file of any length, which is read piece by piece: memory is that of one element. For files of ours:
/// keys that come twice are not looked for.
[[nodiscard]] Json read_json_elements(const Path& file, const TakeElement& take);

/// Indented by two, newline at the end.
[[nodiscard]] std::string to_text(const Json& json);

/// Each place where two documents differ: "sensor.netd_mk is 40 here and 50 there".
[[nodiscard]] std::vector<std::string> differences(const Json& here, const Json& there);

}  // namespace thermal
