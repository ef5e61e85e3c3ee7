#pragma once

#include "io/assets.h"
#include "io/json/file.h"
#include "io/system/files.h"
#include "scene/manifest.h"

namespace thermal {

/// Reads and checks a manifest.json (configs/schema/manifest.schema.json). DataError with one line per fault, each
/// starting with the file's name; IoError if it cannot be read.
[[nodiscard]] Manifest read_manifest(const Path& file, const Assets& assets);

/// Entries of a manifest, or of a baked scene, that conform to its schema.
[[nodiscard]] CameraIntrinsics intrinsics_of(const Json& json);
[[nodiscard]] ManifestObject manifest_object_of(const Json& json);
[[nodiscard]] ManifestMaterial manifest_material_of(const Json& json);

}  // namespace thermal
