#pragma once

#include <string>

#include "dataset/clip/maker.h"

namespace thermal {

/// Identity of a clip's passes without reading their pixels: SHA-256 of the manifest's document, and the name and size
/// of every frame's file and of the side-car files of its cryptomatte. Copies have the same identity.
[[nodiscard]] std::string identity_of(const ClipPasses& passes);

/// Whether a clip with this record was made from other passes: their identity_sha256 differs, or one of these files was
/// written after `record_file`, its clip.json. True for a record without identity.
[[nodiscard]] bool has_changed(const ClipPasses& passes, const std::string& made_from_sha256,
                               const Path& record_file);

}  // namespace thermal
