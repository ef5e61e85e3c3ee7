#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/json_file.h"
#include "labels/label_parameters.h"
#include "scene/lens_distortion.h"
#include "scene/season.h"
#include "scene/terms.h"
#include "scene/weather.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

struct ClipConfig {
  std::string id;
  Season season = Season::winter;
  int frames = 0;
  double frame_rate_hz = 9;
};

/// A dataset config: the parts the thermal side acts on, and the whole document with every default filled in.
struct Config {
  std::string name;
  std::uint32_t seed = 1;
  int width_px = 640;
  int height_px = 512;
  LensDistortion distortion;
  int overscan_px = 0;  ///< what the passes reach beyond the picture on every side
  SensorParameters sensor;
  LabelParameters labels;
  bool physical = false;  ///< every term the scene needs; else the published model
  TermChoices terms;
  double netd_k = 0.04;
  std::optional<double> air_temperature_k;  ///< instead of the season's
  std::optional<double> relative_humidity;
  std::optional<double> cloud_fraction;
  double vehicle_stopped_s = 3600;
  std::vector<ClipConfig> clips;
  Json resolved;

  /// ConfigError naming the nearest id if there is no such clip. `where` says who asked.
  [[nodiscard]] const ClipConfig& clip(const std::string& id, const std::string& where) const;
};

/// The weather of a clip: its season's, with what the config says instead.
[[nodiscard]] Weather weather_of(const Config& config, Season season);

/// Sets the season of every clip and flight of a document.
void set_season(Json& document, const Json& season);

/// Changes one value of a document before it is checked. `assignment` is "key.other[2].last=value", the value
/// JSON or else a plain string; "season=…" sets the season of every clip and flight. ConfigError if the form is off.
void apply_setting(Json& document, const std::string& assignment);

/// Names in full the files that a document names relative to `folder`: the user's maps of the terrain.
void root_files(Json& document, const Path& folder);

/// The same config, whose flights are cut into these clips, as a config has them, after its own.
[[nodiscard]] Config with_flights_cut(Config config, const Json& clips);

/// Checks a document against configs/schema/config.schema.json and fills in its defaults.
/// ConfigError with a line a fault, each starting with `name`.
[[nodiscard]] Config resolve_config(Json document, const std::string& name, const Path& home);

}  // namespace thermal
