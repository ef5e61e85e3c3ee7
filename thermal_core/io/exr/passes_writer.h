#pragma once

#include <string>
#include <string_view>

#include "io/system/files.h"
#include "scene/passes.h"

namespace thermal {

/// The layer of what water mirrors.
inline constexpr std::string_view kMirrorLayer = "Mirror";

/// The pass, in the layer of the object index, that is 1 where a pixel has samples of its own (sampled_places()), in
/// files of passes that are sampled where it matters.
inline constexpr std::string_view kSampledPass = "Sampled";

/// How the pixels of a file are stored; all are lossless.
enum class ExrPacking { none, run_lengths };

/// Writes the planes of a frame that are not empty, as Blender does: single precision, in layer `layer` "IndexOB.X",
/// "IndexMA.X", "Depth.Z" and "Normal.X" to "Normal.Z", in `actor_layer` "IndexOB.X", and in kMirrorLayer what is
/// mirrored, with the names of `layer`. Planes that are sampled where it matters have all samples in the file, and
/// kSampledPass says which pixels have their own, so that what is read is what was written. The file appears when it is
/// complete. IoError with the file; TryAgainError if the disk is full.
void write_passes(const Path& file, const Passes& passes, const std::string& layer,
                  const std::string& actor_layer, ExrPacking packing);

}  // namespace thermal
