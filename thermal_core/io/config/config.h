#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/assets.h"
#include "io/json/file.h"
#include "io/video/video_codec.h"
#include "labels/label_parameters.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"
#include "scene/season.h"
#include "scene/terms.h"
#include "scene/weather.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// What renders the passes: Cycles in Blender, or the library's ray caster (raycast/).
enum class Engine { blender, embree };

struct ClipConfig {
  std::string id;
  Season season = Season::winter;
  int frames = 0;
  double frame_rate_hz = 9;
  double start_s = 0;  ///< scene time of the first frame
};

/// A dataset config: the parts that the thermal side uses, and the whole document with all defaults filled in.
struct Config {
  std::string name;
  std::uint32_t seed = 1;
  int width_px = 640;
  int height_px = 512;
  CameraIntrinsics camera;
  bool gives_intrinsics = false;  ///< the document gives some of the camera's, directly or by a calibration
  LensDistortion distortion;
  int overscan_px = 0;     ///< how far the passes extend beyond the picture on every side
  int view_margin_px = 0;  ///< of the view, by lens and overscan, beyond each side of a pinhole's picture
  int supersample = 1;     ///< rays of the passes along each side of a pixel
  bool actor_layer = false;
  Engine engine = Engine::blender;
  bool adaptive_sampling = false;  ///< all rays only for pixels that need them; with `embree`
  SensorParameters sensor;
  LabelParameters labels;
  std::optional<VideoCodecSettings> codec;  ///< that 8-bit frames pass through; empty: none
  bool physical = false;                    ///< every term the scene needs; otherwise the published model
  TermChoices terms;
  double netd_k = 0.04;
  bool heat_balance = false;       ///< temperatures follow the weather; otherwise those of Table 1
  std::array<Weather, 2> weather;  ///< by season; see weather_of()
  std::vector<ClipConfig> clips;
  std::vector<std::string> flights;  ///< ids of long flights, from which clips are cut
  Json resolved;                     ///< for the record; computations use the fields above

  /// ConfigError with the nearest id if the clip is unknown. `where` names the source of the id.
  [[nodiscard]] const ClipConfig& clip(const std::string& id, const std::string& where) const;
};

/// The weather of a clip in its middle: its season's, overridden by the config's. With the temperatures of Table 1, the
/// air is the same at all times.
[[nodiscard]] Weather weather_of(const Config& config, const ClipConfig& clip);

/// The same at scene time 0.
[[nodiscard]] Weather weather_of(const Config& config, Season season);

/// When each season is flown, in hours of local solar time, from and to; beyond 24 for flights over midnight.
[[nodiscard]] std::map<Season, std::vector<std::pair<double, double>>> flown_hours(const Config& config);

/// Sets the season of every clip and flight of a document.
void set_season(Json& document, const Json& season);

/// Changes one value of a document before it is checked. `assignment` is "key.other[2].last=value", with the value as
/// JSON or a plain string; "season=…" sets the season of every clip and flight. ConfigError if the form is invalid.
void apply_setting(Json& document, const std::string& assignment);

/// Makes paths that a document gives relative to `folder` absolute: a calibration, maps of the terrain.
void root_files(Json& document, const Path& folder);

/// The same for the calibration alone, which is what converting existing passes needs.
void root_calibration(Json& document, const Path& folder);

/// The same config with these clips, which follow its own, instead of its flights.
[[nodiscard]] Config with_clips(Config config, const Json& clips);

/// Checks a document against configs/schema/config.schema.json and fills in its defaults. The numbers of a camera's
/// calibration replace the name of its file. ConfigError with one line per fault, each starting with `name`.
[[nodiscard]] Config resolve_config(Json document, const std::string& name, const Assets& assets);

}  // namespace thermal
