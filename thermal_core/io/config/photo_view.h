#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/assets.h"
#include "io/image/pictures.h"
#include "io/json/file.h"

namespace thermal {

/// A preset as photos know it.
struct CameraPreset {
  std::string name;
  std::vector<std::string> models;  ///< in EXIF's Model of its photos
  PictureSize size;
  double focal_length_m = 0;
  double pixel_pitch_um = 0;
};

/// All presets that name models of photos, by name. `schema`: that of configs. ConfigError as apply_preset().
[[nodiscard]] std::vector<CameraPreset> photographed_presets(const Json& schema, const Assets& assets);

/// What a thermal photo says of its camera and its view, as parts of a config.
struct PhotoView {
  Json camera;   ///< with the members `sensor` and, where they differ from the preset, `camera`
  Json weather;  ///< date, time, latitude_deg, elevation_m, as far as they are known
  std::optional<double> altitude_m;      ///< above the place of take-off
  std::optional<double> look_angle_deg;  ///< below the horizon
  std::optional<double> heading_deg;     ///< of the aircraft, counter-clockwise from +x, which is east
  std::vector<std::string> remarks;      ///< what is missing, and what was taken instead
};

/// Reads DJI's XMP tags (drone-dji), FLIR's (FLIR), Pix4D's (Camera), and EXIF. Numbers that a config could not have
/// count as missing. DataError, without the file's name, for photos of a visible camera and for pictures without tags of
/// a camera.
[[nodiscard]] PhotoView read_photo_view(const PhotoTags& tags, const std::vector<CameraPreset>& presets);

}  // namespace thermal
