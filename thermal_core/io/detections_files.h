#pragma once

#include <vector>

#include "io/files.h"
#include "labels/detection.h"
#include "labels/label_set.h"

namespace thermal {

/// What a detector saw in the pictures of `truth`, in one of two forms:
/// - a COCO results file, [{"image_id", "category_id", "bbox", "score"}, …]; other keys are passed over;
/// - a folder of YOLO results, a file NAME.txt a picture, NAME as flat_name() has it or the picture's own where no other
///   has the same, with lines "class cx cy w h score": the class from 0 in the order of the categories, the box's
///   centre and sides in parts of the picture's. In a picture without a file nothing was seen; files with other
///   endings are passed over.
/// There may be no detections at all.
/// DataError "FILE: [3].score = null; expected …" or "FILE:LINE: …" for pictures and categories that `truth` has not,
/// boxes and scores that are no finite numbers, sides below 0, boxes that do not even touch their picture, and what
/// is not of these forms; IoError if it cannot be read.
[[nodiscard]] std::vector<Detection> read_detections(const Path& source, const LabelSet& truth);

}  // namespace thermal
