#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/system/files.h"
#include "labels/box_style.h"
#include "labels/label_set.h"

namespace thermal {

/// Where frames come from: a Veldt dataset, whose ir8 they are, or a folder of pictures of grey levels.
struct FrameRequest {
  Path source;
  Path labels = {};  ///< COCO file of a folder; empty: annotations.json in it or in its parent, if there
  std::string names = {};                ///< of a folder: pattern as of FrameNames; empty: names say nothing
  std::string names_option = "--names";  ///< what messages call it
  std::string category = {};             ///< of the boxes, in any case; empty: people
  BoxStyle boxes = BoxStyle::visible;    ///< of a dataset
};

struct SourceFrame {
  Path file;
  std::string name;
  std::size_t video = 0;             ///< clip; 0 in a folder
  std::optional<double> altitude_m;  ///< above ground
  std::vector<LabelBox> boxes;       ///< without crowds and ignored ones
};

/// Frames in order, by clip and frame, or by name.
struct FrameSource {
  std::string name;
  bool is_dataset = false;
  std::vector<SourceFrame> frames;
  std::string no_boxes;  ///< why there are none; empty if there are
};

/// Lists the frames of a source and reads its labels; opens no picture.
/// ConfigError for labels and patterns of names for a Veldt dataset, and for drawn boxes of a folder; DataError for a
/// folder without pictures, a name that does not match the pattern, labels that name none of the frames, and those of
/// read_labels() and read_coco(); IoError if the source does not exist.
[[nodiscard]] FrameSource read_frame_source(const FrameRequest& request);

}  // namespace thermal
