#pragma once

#include <string>

#include "io/json/file.h"
#include "io/json/schema.h"

namespace thermal {

/// Takes the distributions out of a value, at every depth: an object with them alone, or empty.
[[nodiscard]] Json take_distributions(Json& value, const Json& rules);

/// Merges members of objects at every depth; anything else is replaced, by null too.
void overlay(Json& into, const Json& changes);

/// A config after its draws: clips with a count are listed one by one, and all values are given.
struct DrawnConfig {
  Json document = {};           ///< without the sections of clips and flights
  Json given = Json::object();  ///< its sections of the dataset, without those values that each clip draws
  Json own_clips = {};          ///< sections of each clip, with what it has drawn of the dataset's
  Json own_flights = {};
  EntryNames places =
      {};  ///< of clips and flights, as the config lists them: `clips[2]`, `clips[2] ("p", 20 clips)`
};

/// Draws all distributions of a config's document before it is checked: those of `scene`, and of what all clips share,
/// once, all others for each clip or flight. Every draw is a function of (seed, id of the clip or flight, path of the key)
/// alone. `drawn` of the document and of its entries lists the paths. ConfigError with one line per fault, each starting
/// with `name`; what is no distribution is left to the schema.
[[nodiscard]] DrawnConfig draw_config(Json document, const Json& schema, const std::string& name);

}  // namespace thermal
