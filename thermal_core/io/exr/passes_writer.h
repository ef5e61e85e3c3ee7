#pragma once

#include <string>
#include <string_view>

#include "io/system/files.h"
#include "scene/passes.h"

namespace thermal {

/// The layer of what water mirrors.
inline constexpr std::string_view kMirrorLayer = "Mirror";

/// How the pixels of a file are stored; all are lossless.
enum class ExrPacking { none, run_lengths };

/// Writes the planes of a frame that are not empty, as Blender does: single precision, in layer `layer`
/// "IndexOB.X", "IndexMA.X", "Depth.Z" and "Normal.X" to "Normal.Z", in `actor_layer` "IndexOB.X", and
/// in kMirrorLayer what is mirrored, with the names of `layer`. The file appears when it is complete. IoError with the file; TryAgainError if the disk is full.
void write_passes(const Path& file, const Passes& passes, const std::string& layer,
                  const std::string& actor_layer, ExrPacking packing);

}  // namespace thermal
