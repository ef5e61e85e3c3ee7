#pragma once

#include <vector>

#include "io/system/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Reads a detector's output for the pictures of `truth`, in one of two formats:
/// - a COCO results file, [{"image_id", "category_id", "bbox", "score"}, …], of any program or of Ultralytics
///   (`save_json=True`). `image_id` is the id of a picture of the truth or, as text, its name; [`file_name`] must be of
///   the same picture, and finds it where `image_id` is no id. Names are those of PictureNames. `category_id` is an
///   id, or an index into the truth's categories from 1. It is an index in a file whose `image_id`s are names or the
///   stems of `file_name`, as Ultralytics writes them, if only that gives each entry a category, and in any file with a
///   picture that is found only by `file_name` or a name beside one. If both interpretations are possible and differ,
///   that is an error. [`bbox_mode`] other than 1, and boxes that are fractions of their pictures (are_fractions(),
///   MegaDetector), are errors; other keys are ignored, such as `segmentation`, `keypoints`, `area` and `id`;
/// - a folder of YOLO results, one file NAME.txt per picture, NAME being one of PictureNames, with lines "class cx cy w h
///   score": the class from 0 in the order of the categories, the box's centre and size relative to the picture's. A
///   picture without a file has no detections; files with other extensions are ignored.
/// The result may be empty.
/// DataError "FILE: [3].score = null; expected …" or "FILE:LINE: …" for unknown pictures and categories, boxes and
/// scores that are not finite, negative sizes, boxes that do not touch their picture, and other formats; IoError if
/// it cannot be read.
[[nodiscard]] std::vector<Detection> read_detections(const Path& source, const LabelSet& truth);

}  // namespace thermal
