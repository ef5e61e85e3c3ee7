#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/assets.h"
#include "io/config/spec.h"
#include "io/json/file.h"

namespace thermal {

/// The sections of a config of which a clip or a flight may have its own.
inline constexpr std::array kClipSections = {"camera", "sensor", "weather", "terms", "labels", "output"};

/// Their keys that describe the place, the size of pictures and the files of the whole dataset.
inline constexpr std::array kOncePerDataset = {"/camera/width_px",      "/camera/height_px",
                                               "/sensor/model",         "/sensor/kelvin_per_count",
                                               "/weather/latitude_deg", "/weather/elevation_m"};

/// The settings of a document whose sections are checked and filled in. `where` starts messages: "night.json: ".
[[nodiscard]] SharedSettings read_settings(const Json& document, const std::string& where,
                                           const Assets& assets);

/// Adds a line for each thing in a checked section `weather` that cannot be in one of the seasons: a date that no calendar
/// has, a minimum of the air above its maximum, a dew point above the air, air given twice.
void check_weather(const Json& weather, std::initializer_list<Season> seasons,
                   std::vector<std::string>& faults);

/// Takes the sections of its own out of a clip or a flight of a config, which is no object if the schema is to say so.
[[nodiscard]] Json take_sections(Json& entry);

/// What turns one object into another by merge_patch(): keys that differ, null for those that are removed. In the order of
/// the first, then by name, whatever the order of the second.
[[nodiscard]] Json difference(const Json& from, const Json& to);

/// Resolves the sections of clips and flights: those of the dataset with what differs.
class SectionResolver {
 public:
  /// `given`: the document before its presets and defaults were filled in; `resolved`: after, and `settings` what it means.
  /// References must outlive this.
  SectionResolver(const Json& given, const Json& resolved, SharedSettings settings, const Json& schema,
                  const std::string& name, const Assets& assets)
      : given_(given),
        resolved_(resolved),
        settings_(std::move(settings)),
        schema_(schema),
        name_(name),
        assets_(assets) {}

  /// What a clip or a flight has of its own.
  struct Own {
    Json changes;  ///< to the dataset's resolved sections, with all numbers filled in
    SharedSettings settings;
  };

  /// `place` is that of the clip or flight: "clips[2]". ConfigError with one line per fault.
  [[nodiscard]] const Own& of(const Json& sections, Season season, const std::string& place);

 private:
  [[nodiscard]] Own resolve(const Json& sections, Season season, const std::string& place) const;

  const Json& given_;
  const Json& resolved_;
  SharedSettings settings_;
  const Json& schema_;
  const std::string& name_;
  const Assets& assets_;
  std::map<std::string, Own> known_;  ///< by season and sections
};

}  // namespace thermal
