#pragma once

#include "io/assets.h"
#include "io/json/file.h"
#include "io/system/files.h"
#include "scene/manifest.h"

namespace thermal {

/// Reads and checks a manifest.json (configs/schema/manifest.schema.json). DataError with one line per fault, each
/// starting with the file's name; IoError if it cannot be read.
[[nodiscard]] Manifest read_manifest(const Path& file, const Assets& assets);

/// The same of a document; `name` begins faults.
[[nodiscard]] Manifest parse_manifest(Json document, const std::string& name, const Assets& assets);

/// A manifest of passes with index planes as JSON, one frame a line; members of other manifests (a cryptomatte, colours,
/// names of channels, a sequence) are left out.
[[nodiscard]] std::string to_text(const Manifest& manifest);

/// Entries of a manifest, or of a baked scene, that conform to its schema.
[[nodiscard]] ManifestObject manifest_object_of(const Json& json);
/// The same of a material.
[[nodiscard]] ManifestMaterial manifest_material_of(const Json& json);
/// The same of a bed that an animal has left.
[[nodiscard]] WarmBed warm_bed_of(const Json& json);

}  // namespace thermal
