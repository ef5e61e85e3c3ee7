#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/video/video_codec.h"
#include "labels/instances.h"
#include "scene/camera_model.h"
#include "scene/terms.h"
#include "scene/weather.h"
#include "sensor/analogue_link.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// What the sections mean of which a clip or a flight may have its own.
struct ClipSettings {
  CameraIntrinsics camera;
  bool gives_intrinsics = false;  ///< the config gives some of the camera's, directly or by a calibration
  LensDistortion distortion;
  SensorParameters sensor;
  LabelParameters labels;
  std::optional<AnalogueLinkParameters> link;  ///< ahead of the codec; empty: none
  std::optional<VideoCodecSettings> codec;     ///< that 8-bit frames pass through; empty: none
  TermChoices terms;
  double netd_k = 0.04;
  std::array<Weather, 2> weather;  ///< by season; see ClipSpec::weather_at()
};

/// Never null; shared by clips with the same settings.
using SharedSettings = std::shared_ptr<const ClipSettings>;

/// All that one clip is made with.
struct ClipSpec {
  std::string id = {};
  Season season = Season::winter;
  int frames = 0;
  double frame_rate_hz = 9;
  double start_s = 0;          ///< scene time of the first frame
  std::string of_flight = {};  ///< id of the flight that it is cut from; empty if there is none
  double speed_m_s = 12;       ///< of the aircraft, as the config has it
  SharedSettings settings = std::make_shared<const ClipSettings>();

  /// Scene time of its middle [s].
  [[nodiscard]] double middle_s() const { return start_s + 0.5 * (frames - 1) / frame_rate_hz; }

  /// Its weather at a scene time [s]: its season's, overridden by its settings. Without `heat_balance`, by which
  /// temperatures follow the weather, the air is the same at all times.
  [[nodiscard]] Weather weather_at(double time_s, bool heat_balance) const;
};

/// A long flight, from which clips are cut.
struct FlightSpec {
  std::string id = {};
  Season season = Season::winter;
  double start_s = 0;
  double duration_s = 0;
  double speed_m_s = 12;
  SharedSettings settings = std::make_shared<const ClipSettings>();

  /// Completes a clip of which id, frames and times are given by what it has of this flight.
  [[nodiscard]] ClipSpec cut(ClipSpec clip) const;
};

/// What renders the passes: Cycles in Blender, or the library's ray caster (raycast/).
enum class Engine { blender, embree };

/// What a config means: all of it that the thermal side uses.
struct DatasetSpec {
  std::string name = {};
  std::uint32_t seed = 1;
  SharedSettings settings = std::make_shared<const ClipSettings>();  ///< of clips that have none of their own
  int width_px = 640;
  int height_px = 512;
  int overscan_px = 0;     ///< how far the passes extend beyond the picture on every side
  int view_margin_px = 0;  ///< of the view, by lens and overscan, beyond each side of a pinhole's picture
  int supersample = 1;     ///< rays of the passes along each side of a pixel
  bool actor_layer = false;
  bool poses_all = false;  ///< a plan has the bones of all actors, whether its cameras see them or not
  Engine engine = Engine::blender;
  std::string engine_reason = {};  ///< why it was chosen, for messages; empty: render.engine names it
  bool adaptive_sampling = false;  ///< all rays only for pixels that need them; with `embree`
  bool physical = false;           ///< every term the scene needs; otherwise the published model
  bool heat_balance = false;       ///< temperatures follow the weather; otherwise those of Table 1
  std::vector<ClipSpec> clips = {};
  std::vector<FlightSpec> flights = {};

  /// For ids that somebody names: ConfigError with the nearest id if the clip is unknown. `where` names their source.
  [[nodiscard]] const ClipSpec& clip(const std::string& id, const std::string& where) const;

  /// Null if there is none.
  [[nodiscard]] const FlightSpec* flight(const std::string& id) const;
};

/// A season under one weather, and when it is flown: hours of local solar time, from and to; beyond 24 for flights over
/// midnight.
struct FlownWeather {
  Season season = Season::winter;
  Weather weather;
  std::vector<std::pair<double, double>> hours;
};

/// All that clips and flights are made in, winter first, then in the order of the config.
[[nodiscard]] std::vector<FlownWeather> flown_weather(const DatasetSpec& spec);

}  // namespace thermal
