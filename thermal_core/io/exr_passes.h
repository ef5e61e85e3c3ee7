#pragma once

#include <string>

#include "io/exr_header.h"
#include "io/exr_scan.h"
#include "io/files.h"
#include "io/pass_buffer.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Depth of pixels that a file's data window leaves out: what Blender writes where there is nothing but sky.
inline constexpr float kDepthOutsideM = 1e10F;

/// Where the planes of a clip's EXR files are.
struct ExrLayout {
  std::string layer = {};        ///< empty: the only one
  std::string actor_layer = {};  ///< empty: none
  PassChannels channels = {};    ///< those with unusual names
  int width_px = 0;              ///< 0: any size
  int height_px = 0;
  ExrLimits limits = {};
};

/// The planes of one frame that are needed, and no others, of the size of the file's display window. Size and
/// limits are checked before any memory is taken. Pixels that the data window leaves out have index 0, normal
/// 0 and kDepthOutsideM. The actors' layer is looked at if actors are needed: a file with no other object
/// index than `layer`'s is one of a frame without actor layer, whose plane stays empty.
/// DataError naming file, channel and pixel if there is no object index or a needed plane is missing, or an
/// index is negative, fractional, NaN or above 32767 (2048 in half floats), or its compression is lossy;
/// IoError if the file cannot be read.
[[nodiscard]] Passes read_passes(const Path& file, const ExrLayout& layout, const PassNeeds& needs = {});

/// The same into a buffer's passes.
void read_passes(const Path& file, const ExrLayout& layout, const PassNeeds& needs, PassBuffer& out);

/// Which planes beside the object index read_passes() would find. The same faults.
[[nodiscard]] PassNeeds planes_in_exr(const Path& file, const ExrLayout& layout);

}  // namespace thermal
