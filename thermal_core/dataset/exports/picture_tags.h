#pragma once

#include <array>
#include <optional>

#include "dataset/exports/geodesy.h"
#include "dataset/exports/plan.h"
#include "io/json/file.h"
#include "radiometry/spectral_response.h"

namespace thermal {

/// Time and camera pose of a frame, from a line of frames.jsonl.
struct FramePose {
  double time_s = 0;                                      ///< of the scene
  std::optional<std::array<double, 16>> camera_to_world;  ///< row-major, OpenCV camera axes
};

/// Metadata of a clip's camera for TIFFs.
struct TaggedCamera {
  std::string model;                     ///< preset of the sensor
  std::optional<double> fx_px;           ///< of the pinhole camera
  std::optional<double> pixel_pitch_um;  ///< of the sensor
  std::optional<double> f_number;
  std::optional<SpectralResponse> response;  ///< empty: unknown
  std::string date;                          ///< "2026-07-09"; empty: unknown
  std::string time;                          ///< local solar time of scene time 0, "03:00"; empty: unknown
};

/// The camera of a clip of a dataset.
/// @param document  the config of dataset.json
/// @param intrinsics  of the clip's video in annotations.json; null if it has none
[[nodiscard]] TaggedCamera tagged_camera(const Json& document, const std::string& clip,
                                         const Json& intrinsics);

/// Tags of a frame. Position and attitude as OpenDroneMap (opendm/photo.py) and Pix4D ("Specifications of XMP camera
/// tags") read them: EXIF's GPS tags, and XMP's Camera:Yaw, Camera:Pitch and Camera:Roll of attitude_of(), relative to
/// north at the camera. No drone-dji tags: OpenDroneMap prefers their GimbalPitchDegree to Camera:Pitch, and corrects
/// its -90 degrees of straight down only for pictures whose Make is DJI. Camera:BandName is LWIR,
/// Camera:CentralWavelength and Camera:WavelengthFWHM [nm] are those of the response.
/// GDAL's metadata have the unit and, for counts, the scale. DataError if the camera is more than 100 km from the
/// origin.
[[nodiscard]] TiffTags picture_tags(const TaggedCamera& camera, const FramePose& pose,
                                    const Georeference& georeference, TiffType type, double kelvin_per_count);

}  // namespace thermal
