#pragma once

#include "io/exr/planes.h"
#include "io/pass_buffer.h"
#include "io/system/files.h"
#include "scene/passes.h"

namespace thermal {

/// Reads the planes of one frame that are needed, and no others, at the size of the file's display window. Size and
/// limits are checked before memory is allocated. Pixels outside the data window have index 0, normal 0 and
/// kSkyDepthM. The actors' layer is read if actors are needed; a file whose only object index is that of `layer`
/// is a frame without an actor layer, and the plane stays empty. Planes of a file with kSampledPass are separated().
/// Of the headers, channels, windows, compression, parts, tiles, views, pixelAspectRatio and envmap are used, and other
/// attributes ignored.
/// DataError with file, channel and pixel if there is no object index or a needed plane is missing, or an index is
/// negative, fractional, NaN or above 32767 (2048 in half floats), or its compression is lossy, and for pictures that
/// check_projection() refuses; IoError if the file cannot be read.
[[nodiscard]] Passes read_passes(const Path& file, const ExrLayout& layout, const PassNeeds& needs = {});

/// The same into a buffer's passes.
void read_passes(const Path& file, const ExrLayout& layout, const PassNeeds& needs, PassBuffer& out);

/// Which planes besides the object index read_passes() would find. The same faults.
[[nodiscard]] PassNeeds planes_in_exr(const Path& file, const ExrLayout& layout);

}  // namespace thermal
