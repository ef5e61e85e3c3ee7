#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/assets.h"
#include "io/config/clip_settings.h"
#include "io/json/file.h"
#include "scene/weather.h"

namespace thermal {

/// What renders the passes: Cycles in Blender, or the library's ray caster (raycast/).
enum class Engine { blender, embree };

/// A clip of a config.
struct ClipConfig {
  std::string id;
  Season season = Season::winter;
  int frames = 0;
  double frame_rate_hz = 9;
  double start_s = 0;            ///< scene time of the first frame
  SharedSettings own = nullptr;  ///< null: those of the dataset; see settings_of()
};

/// A dataset config: the parts that the thermal side uses, and the whole document with all defaults filled in. Its
/// settings are those of clips that have none of their own.
struct Config : ClipSettings {
  std::string name;
  std::uint32_t seed = 1;
  int width_px = 640;
  int height_px = 512;
  int overscan_px = 0;     ///< how far the passes extend beyond the picture on every side
  int view_margin_px = 0;  ///< of the view, by lens and overscan, beyond each side of a pinhole's picture
  int supersample = 1;     ///< rays of the passes along each side of a pixel
  bool actor_layer = false;
  bool poses_all = false;  ///< a plan has the bones of all actors, whether its cameras see them or not
  Engine engine = Engine::blender;
  std::string engine_reason;       ///< why it was chosen, for messages; empty: render.engine names it
  bool adaptive_sampling = false;  ///< all rays only for pixels that need them; with `embree`
  bool physical = false;           ///< every term the scene needs; otherwise the published model
  bool heat_balance = false;       ///< temperatures follow the weather; otherwise those of Table 1
  std::vector<ClipConfig> clips;
  std::vector<std::string> flights;                      ///< ids of long flights, from which clips are cut
  std::map<std::string, SharedSettings> own_of_clips;    ///< by id: of those that have settings of their own
  std::map<std::string, SharedSettings> own_of_flights;  ///< the same of long flights
  Json resolved;  ///< for the record; computations use the fields above

  /// ConfigError with the nearest id if the clip is unknown. `where` names the source of the id.
  [[nodiscard]] const ClipConfig& clip(const std::string& id, const std::string& where) const;
};

/// What a clip is made with.
[[nodiscard]] const ClipSettings& settings_of(const Config& config, const ClipConfig& clip);

/// The weather of a clip in its middle: its season's, overridden by the config's and the clip's. With the temperatures of Table 1, the
/// air is the same at all times.
[[nodiscard]] Weather weather_of(const Config& config, const ClipConfig& clip);

/// The same at scene time 0, so that clips under the same weather share it.
[[nodiscard]] Weather weather_at_start(const Config& config, const ClipConfig& clip);

/// A season under one weather, and when it is flown: hours of local solar time, from and to; beyond 24 for flights over
/// midnight.
struct FlownWeather {
  Season season = Season::winter;
  Weather weather;
  std::vector<std::pair<double, double>> hours;
};

/// All that clips and flights are made in, winter first, then in the order of the config.
[[nodiscard]] std::vector<FlownWeather> flown_weather(const Config& config);

/// Sets the season of every clip and flight of a document.
void set_season(Json& document, const Json& season);

/// Changes one value of a document before it is checked. `assignment` is "key.other[2].last=value", with the value as
/// JSON or a plain string; "season=…" sets the season of every clip and flight. ConfigError if the form is invalid.
void apply_setting(Json& document, const std::string& assignment);

/// Makes paths that a document gives relative to `folder` absolute: calibrations, maps of the terrain, flights, views.
void root_files(Json& document, const Path& folder);

/// The same for what resolve_config() reads alone, calibrations and views, which is what converting existing passes needs.
void root_resolved_files(Json& document, const Path& folder);

/// The clip of a config that is cut from one of its flights.
[[nodiscard]] Json cut_from(const Json& flight, Json clip);

/// The same config with these clips, which follow its own, instead of its flights. Each is one of its own, or cut from a
/// flight, and has their settings.
[[nodiscard]] Config with_clips(Config config, const Json& clips);

/// Checks a document against configs/schema/config.schema.json and fills in its defaults. The numbers of a camera's
/// calibration replace the name of its file. ConfigError with one line per fault, each starting with `name`.
[[nodiscard]] Config resolve_config(Json document, const std::string& name, const Assets& assets);

/// What must be given to go on with what was made from a resolved config: the same config, and its engine if that is the
/// one that differs.
[[nodiscard]] std::string expected_config(const Json& here, const Json& there);

}  // namespace thermal
