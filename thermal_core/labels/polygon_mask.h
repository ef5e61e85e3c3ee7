#pragma once

#include <span>
#include <vector>

#include "labels/rle.h"

namespace thermal {

/// The mask of polygons, each x, y, x, y, … in pixels, in a picture of this size: a pixel is in it if it is in one of
/// them. Equal to pycocotools' (`merge(frPyObjects(…))`) in each pixel: corners are rounded to fifths of a pixel; a
/// border goes from corner to corner in steps of a fifth along its longer axis; where it crosses the middle of a column
/// of pixels, the pixels below toggle between outside and inside. Runs cover the picture; parts outside it are cut off.
/// Polygons have an even number of coordinates, all within 1e8 px, and the picture at most 2^32 - 1 pixels. DataError
/// for borders that cross columns more than 4 million times.
[[nodiscard]] RunLengths mask_of_polygons(std::span<const std::vector<double>> polygons, int width_px,
                                          int height_px);

}  // namespace thermal
