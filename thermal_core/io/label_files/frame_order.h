#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/json/entry.h"
#include "labels/label_set.h"

namespace thermal {

/// A picture as stated by an entry of a COCO file.
struct StatedImage {
  LabelImage image;
  std::optional<LabelId> video_id = {};
  std::optional<LabelId> sequence_id = {};  ///< of COCO Camera Traps
  std::optional<int> frame = {};
  std::string frame_key = {};  ///< the key that states it
};

/// Reads the frame of a picture: `frame_index`, CocoVID's `frame_id` or COCO Camera Traps' `frame_num`. DataError if two
/// of them differ.
void read_frame_of(const JsonEntry& entry, StatedImage& image);

/// Sets each picture's index in its video, which is known already: the stated index, or else its rank in the natural
/// order of names (compare_names()). The order of pictures in a COCO file has no meaning. If names differ in more than
/// numbers, the video is not `in_time`.
/// DataError "FILE: images[3].frame_id = …; expected …" if a video states one frame twice, or only some of its frames.
void order_frames(const std::string& file, std::vector<StatedImage>& images, std::vector<LabelVideo>& videos);

}  // namespace thermal
