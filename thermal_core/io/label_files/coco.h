#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/system/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Labels of a COCO detection file, or of one of its family: CocoVID (mmtracking, BDD100K), COCO Camera Traps. Size
/// classes need assign_size_classes(). Memory is that of the labels, not of a JSON tree.
///
/// Keys that are used, those in brackets if present:
/// - categories: `id`, `name`. Category 0, "empty", is none: an annotation of it without a box says that its picture
///   has no targets;
/// - videos: `id`, `name` or `file_name`, [`frame_rate_hz` or `fps`];
/// - images: `id`, `file_name` ("\" between folders becomes "/"), [`width`, `height`, `time_s`]. The video is
///   [`video_id`], the sequence [`seq_id`], or else the folder: it is named after the file if there is none. The order
///   in it is [`frame_index`], [`frame_id`] or [`frame_num`], or else that of the names' numbers: see order_frames();
/// - annotations: `id`, `image_id`, `category_id`, `bbox`, [`area`, `iscrowd`, `ignore`, `track_id` or `instance_id`,
///   `visibility`, `occluded`, `truncated`, `truncated_fraction`, `range_m`, `temperature_k`, `contrast_k`,
///   `contrast_noise`, `noisy`]; a [`mot_conf`] of 0 is `ignore`.
///
/// Ids are whole numbers of 64 bits, also as floats up to 2^53 (1.0 is 1), or text. Keys that would change the meaning
/// of these are errors: `bbox_mode` other than 1 (Detectron2), `score` other than 1 (results of a detector),
/// `neg_category_ids` and `not_exhaustive_category_ids` (LVIS, where labels are incomplete on purpose), `detections`
/// (MegaDetector); so are boxes that are fractions of their pictures (are_fractions()). All others are ignored, such as
/// `supercategory`, `keypoints`, `attributes`, `location`, `datetime` and `rights_holder`. `segmentation` is ignored
/// here; exports read it.
///
/// DataError "FILE: annotations[3].bbox = …; expected …" for these, for repeated ids, unknown images or categories,
/// pictures that are empty and have labels, and boxes that are not four finite numbers, empty or outside their picture;
/// IoError if the file cannot be read.
[[nodiscard]] LabelSet read_coco(const Path& file);

/// The part of a COCO file before its images.
struct CocoHead {
  std::vector<std::pair<std::string, std::int64_t>> categories;  ///< names with ids, in the file's order
  std::vector<std::string> videos;                               ///< names
};

/// The lists `categories` and `videos` of a COCO file as Veldt writes it, up to the list `images`, which may have
/// gigabytes and is not read. Memory is that of one entry.
/// DataError with file, place and value for an entry without its name or id, or if there are no categories; IoError if
/// the file cannot be read, is no regular one, or if it or its folder is a link.
[[nodiscard]] CocoHead read_coco_head(const Path& file);

}  // namespace thermal
