#pragma once

#include <vector>

#include "io/system/files.h"
#include "labels/detection.h"
#include "labels/label_set.h"

namespace thermal {

/// Reads a detector's output for the pictures of `truth`, in one of two formats:
/// - a COCO results file, [{"image_id", "category_id", "bbox", "score"}, …]; other keys are ignored;
/// - a folder of YOLO results, one file NAME.txt per picture, NAME being flat_name() or, if unique, the picture's own
///   name, with lines "class cx cy w h score": the class from 0 in the order of the categories, the box's centre and
///   size relative to the picture's. A picture without a file has no detections; files with other extensions are
///   ignored.
/// The result may be empty.
/// DataError "FILE: [3].score = null; expected …" or "FILE:LINE: …" for unknown pictures and categories, boxes and
/// scores that are not finite, negative sizes, boxes that do not touch their picture, and other formats; IoError if
/// it cannot be read.
[[nodiscard]] std::vector<Detection> read_detections(const Path& source, const LabelSet& truth);

}  // namespace thermal
