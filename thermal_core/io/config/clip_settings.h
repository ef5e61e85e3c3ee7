#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/assets.h"
#include "io/json/file.h"
#include "io/video/video_codec.h"
#include "labels/instances.h"
#include "scene/camera_model.h"
#include "scene/terms.h"
#include "scene/weather.h"
#include "sensor/analogue_link.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// The sections of a config of which a clip or a flight may have its own.
inline constexpr std::array kClipSections = {"camera", "sensor", "weather", "terms", "labels", "output"};

/// Their keys that describe the place, the size of pictures and the files of the whole dataset.
inline constexpr std::array kOncePerDataset = {"/camera/width_px",      "/camera/height_px",
                                               "/sensor/model",         "/sensor/kelvin_per_count",
                                               "/weather/latitude_deg", "/weather/elevation_m"};

/// What these sections mean.
struct ClipSettings {
  CameraIntrinsics camera;
  bool gives_intrinsics = false;  ///< the document gives some of the camera's, directly or by a calibration
  LensDistortion distortion;
  SensorParameters sensor;
  LabelParameters labels;
  std::optional<AnalogueLinkParameters> link;  ///< ahead of the codec; empty: none
  std::optional<VideoCodecSettings> codec;     ///< that 8-bit frames pass through; empty: none
  TermChoices terms;
  double netd_k = 0.04;
  std::array<Weather, 2> weather;  ///< by season; see weather_of()
};

/// Shared by clips with the same settings.
using SharedSettings = std::shared_ptr<const ClipSettings>;

/// The settings of a document whose sections are checked and filled in. `where` starts messages: "night.json: ".
[[nodiscard]] ClipSettings read_settings(const Json& document, const std::string& where,
                                         const Assets& assets);

/// Takes the sections of its own out of a clip or a flight of a config, which is no object if the schema is to say so.
[[nodiscard]] Json take_sections(Json& entry);

/// What turns one object into another by merge_patch(): keys that differ, null for those that are removed. In the order of
/// the first, then by name, whatever the order of the second.
[[nodiscard]] Json difference(const Json& from, const Json& to);

/// Resolves the sections of clips and flights: those of the dataset with what differs.
class SectionResolver {
 public:
  /// `given`: the document before its presets and defaults were filled in; `resolved`: after. All must outlive this.
  SectionResolver(const Json& given, const Json& resolved, const Json& schema, const std::string& name,
                  const Assets& assets)
      : given_(given), resolved_(resolved), schema_(schema), name_(name), assets_(assets) {}

  /// What a clip or a flight has of its own.
  struct Own {
    Json changes;                       ///< to the dataset's resolved sections, with all numbers filled in
    SharedSettings settings = nullptr;  ///< null: the dataset's
  };

  /// `place` is that of the clip or flight: "clips[2]". ConfigError with one line per fault.
  [[nodiscard]] const Own& of(const Json& sections, Season season, const std::string& place);

 private:
  [[nodiscard]] Own resolve(const Json& sections, Season season, const std::string& place) const;

  const Json& given_;
  const Json& resolved_;
  const Json& schema_;
  const std::string& name_;
  const Assets& assets_;
  std::map<std::string, Own> known_;  ///< by season and sections
};

}  // namespace thermal
