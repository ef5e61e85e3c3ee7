#pragma once

#include <string>
#include <vector>

#include "io/assets.h"
#include "io/json/file.h"

namespace thermal {

/// One of several datasets made from the same passes: its changes to the config they share.
struct Variant {
  std::string name;   ///< of its folder
  std::string where;  ///< start of messages: "variants.json: variants[1] (summer_boson)"
  Json changes;       ///< by key of a config; "season" sets that of every clip
};

/// Checks a list of variants against configs/schema/variants.schema.json. A variant's changes are checked when they
/// are part of a config (changed_by, resolve_config). ConfigError with one line per fault, each starting with `name`.
[[nodiscard]] std::vector<Variant> read_variants(Json document, const std::string& name,
                                                 const Assets& assets);

/// A config's document with the variant's changes: objects are merged key by key, null removes
/// a key, anything else is replaced.
[[nodiscard]] Json changed_by(const Variant& variant, Json document);

}  // namespace thermal
