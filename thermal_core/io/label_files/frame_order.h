#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/json/entry.h"
#include "labels/label_set.h"

namespace thermal {

/// A picture as an entry of a COCO file states it.
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

/// Gives each picture its index in its video, which is known already: the one that is stated, or else its place in the
/// order of the names' numbers (compare_names()). A COCO file gives no meaning to the order of its pictures. Where names
/// differ in something else than a number, the video is not `in_time`.
/// DataError "FILE: images[3].frame_id = …; expected …" if a video states one frame twice, or only some of its frames.
void order_frames(const std::string& file, std::vector<StatedImage>& images, std::vector<LabelVideo>& videos);

}  // namespace thermal
