#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "labels/label_set.h"

namespace thermal {

/// Input of an export, and the split of each video.
struct ExportInput {
  LabelSet set;                       ///< its pictures have sizes, if the format needs them
  std::vector<std::string> splits;    ///< names; a single one without splits
  std::vector<std::size_t> of_video;  ///< for each video with pictures, its index into `splits`
  bool split_asked = false;
  bool boxes_changed = false;  ///< boxes of the set differ from those of its file
};

/// A picture that goes into an export.
struct PlannedPicture {
  std::size_t image = 0;  ///< index into the set's images
  std::string to;         ///< relative to the export's folder, "/" between folders
};

/// A text file of an export.
struct PlannedText {
  std::string to;
  std::string content;
  std::string of = {};  ///< the picture that it belongs to, for messages; empty: none
};

/// A tar file of pictures with their labels.
struct PlannedShard {
  std::string to;
  std::vector<std::size_t> images;  ///< indices into the set's images
};

/// All files of an export: pictures, with or without labels, single or in shards, and text files.
struct ExportPlan {
  std::vector<PlannedPicture> pictures;
  std::vector<PlannedShard> shards;
  std::vector<PlannedText> texts;
};

/// Where the labels of each image start; one more entry for the end.
[[nodiscard]] std::vector<std::size_t> first_labels(const LabelSet& set);

/// A name usable for one file or folder: "/" and "\" become "_".
[[nodiscard]] std::string file_name_of(std::string name);

/// ".png" of "a/b.png"; empty without an extension.
[[nodiscard]] std::string ending_of(const std::string& file);

/// DataError with the labels unless all have tracks, unique within a picture. `format` is the format that needs them.
void check_tracks(const LabelSet& set, std::string_view format);

/// DataError if the order of the pictures of an image's video is unknown. `format` is the format that needs it.
void check_in_time(const LabelSet& set, const LabelImage& image, std::string_view format);

/// DataError if a file would be written outside the export's folder, or over another one.
void check_targets(const ExportPlan& plan, const LabelSet& set);

}  // namespace thermal
