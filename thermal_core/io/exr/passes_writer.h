#pragma once

#include <string>
#include <string_view>

#include "io/system/files.h"
#include "scene/passes.h"

namespace thermal {

/// The layer of mirrored surfaces.
inline constexpr std::string_view kMirrorLayer = "Mirror";

/// The pass, in the layer of the object index, that is 1 where a pixel has samples of its own (sampled_mask()), in
/// files of adaptively sampled passes.
inline constexpr std::string_view kSampledPass = "Sampled";

/// How the pixels of a file are stored; all are lossless.
enum class ExrPacking { none, run_lengths };

/// Writes the planes of a frame that are not empty, as Blender does: single precision, in layer `layer` "IndexOB.X",
/// "IndexMA.X", "Depth.Z" and "Normal.X" to "Normal.Z", in `actor_layer` "IndexOB.X", and in kMirrorLayer what is
/// mirrored, with the names of `layer`. Adaptively sampled planes are expanded in the file, and kSampledPass marks the
/// pixels with samples of their own, so that reading restores them. The file appears when it is complete. IoError with
/// the file; TryAgainError if the disk is full.
void write_passes(const Path& file, const Passes& passes, const std::string& layer,
                  const std::string& actor_layer, ExrPacking packing);

}  // namespace thermal
