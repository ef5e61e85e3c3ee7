#pragma once

#include <cstddef>
#include <map>
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

/// "night/000000" of "night\000000.png".
[[nodiscard]] std::string name_without_ending(std::string name);

/// Pictures of labels by the names that results of a detector may use: flat_name(), the name with its folders, and the
/// file name alone if it is unique; with or without extension, with "/" or "\" between folders.
class PictureNames {
 public:
  /// `set` must outlive this.
  explicit PictureNames(const LabelSet& set);

  /// Empty for an unknown name. DataError, beginning with `where`, for an ambiguous one.
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name, const std::string& where) const;

  /// Whether a name, with any number of its folders, is one of this picture.
  [[nodiscard]] bool is_name_of(const std::string& name, std::size_t image) const;

  /// "; did you mean "x"?", or empty without a near miss.
  [[nodiscard]] std::string suggestion_for(const std::string& name) const;

 private:
  struct Place {
    std::size_t image = 0;
    std::optional<std::size_t> other = {};  ///< another picture of this name
  };
  using Places = std::map<std::string, Place>;

  static void add(Places& places, const std::string& name, std::size_t image);

  const LabelSet& set_;
  Places places_;
};

}  // namespace thermal
