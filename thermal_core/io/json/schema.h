#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/json/file.h"

namespace thermal {

/// What messages call the entries of a list, by the list's key: {"clips": {"clips[0]", "clips[1]"}}. Entries that were
/// made of one may share a name.
using EntryNames = std::map<std::string, std::vector<std::string>>;

/// Checks a document against a JSON schema (the keywords that our schemas use: type, properties, additionalProperties,
/// minProperties of 1, required, enum, minimum, maximum, exclusiveMinimum, pattern, minItems, maxItems, items) and fills
/// in every default. Returns all faults as "<where> = <value> <unit>; expected <rule>", with the unit from the key's
/// suffix; empty if there are none. `where` is the path of the document within a larger one, if it is a part. Only the
/// first of several faults at one path is returned. Our own implementation, because errors are part of the interface: a
/// library's messages name the failed rule, not what to write.
[[nodiscard]] std::vector<std::string> check_and_fill(Json& document, const Json& schema,
                                                      const std::string& where = "",
                                                      const EntryNames& names = {});

/// Unit of a key's suffix, as in "speed_m_s" -> "m/s"; empty if it has none.
[[nodiscard]] std::string unit_of_key(std::string_view key);

}  // namespace thermal
