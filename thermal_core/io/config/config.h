#pragma once

#include <string>
#include <vector>

#include "io/assets.h"
#include "io/config/spec.h"
#include "io/json/file.h"
#include "io/json/schema.h"

namespace thermal {

/// A dataset config, and what it means.
struct ResolvedConfig {
  Json
      document;  ///< with all defaults: for the planner, for files, to compare with another and to change keys of
  DatasetSpec
      spec;  ///< has the document's clips and flights, in its order; what is computed is computed from it
  EntryNames entries;  ///< of the user's config, which made these: see DrawnConfig
};

/// Sets the season of every clip and flight of a document.
void set_season(Json& document, const Json& season);

/// Changes one value of a document before it is checked. `assignment` is "key.other[2].last=value", with the value as
/// JSON or a plain string; "season=…" sets the season of every clip and flight. ConfigError if the form is invalid.
void apply_setting(Json& document, const std::string& assignment);

/// Makes paths that a document gives relative to `folder` absolute: calibrations, maps of the terrain, flights, views.
void root_files(Json& document, const Path& folder);

/// The same for what resolve_config() reads alone, calibrations and views, which is what converting existing passes needs.
void root_resolved_files(Json& document, const Path& folder);

/// The same config with these clips in place of its own and its flights: each is one of its own, or cut from a flight.
[[nodiscard]] ResolvedConfig with_clips(ResolvedConfig config, std::vector<ClipSpec> clips);

/// Checks a document against configs/schema/config.schema.json and fills in its defaults. The numbers of a camera's
/// calibration replace the name of its file. ConfigError with one line per fault, each starting with `name`.
[[nodiscard]] ResolvedConfig resolve_config(Json document, const std::string& name, const Assets& assets);

/// What must be given to go on with what was made from a resolved config: the same config, and its engine if that is the
/// one that differs.
[[nodiscard]] std::string expected_config(const Json& here, const Json& there);

}  // namespace thermal
