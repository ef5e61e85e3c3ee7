#pragma once

#include <string>

#include "dataset/exports/export_folder.h"
#include "dataset/exports/plan.h"
#include "dataset/progress.h"
#include "io/image/pictures.h"

namespace thermal {

/// TIFFs of apparent temperature in the layout of OpenDroneMap, one project per clip: CLIP/images/CLIP_000000.tif and
/// the clip's labels, CLIP/annotations.json; with splits below SPLIT/.
/// @param coco  the COCO file of the labels
/// @param name  its name in messages
[[nodiscard]] ExportPlan plan_tiff(const ExportInput& input, const std::string& coco,
                                   const std::string& name);

/// Default position of a scene: 23 deg east, in the savanna, at the latitude and height of the config's weather, by
/// default 19 deg south and 900 m; at most 89 deg from the equator.
[[nodiscard]] GeoPosition default_origin(const Path& dataset);

/// "LAT,LON" or "LAT,LON,HEIGHT" in degrees and metres. ConfigError for anything else, latitudes beyond 89 and
/// longitudes beyond 180 degrees, and heights outside -500 to 9000 m.
[[nodiscard]] GeoPosition parse_origin(const std::string& text, double default_height_m);

/// Writes the planned pictures, several at once, with the tags of picture_tags(). Kelvin are rounded once, to within
/// 1.6e-5 K below 512 K and 3.1e-5 K above. Returns how many have no pose, and so no position and attitude. DataError
/// for a picture that is not a 16-bit PNG and for a clip without valid frames.jsonl; IoError, TryAgainError or
/// Cancelled.
int write_tiffs(const ExportPlan& plan, const ExportInput& input, const ExportOptions& options,
                const GeoPosition& origin, const std::string& coco, const ExportFolder& folder,
                const RunHooks& hooks);

}  // namespace thermal
