#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "labels/label_set.h"

namespace thermal {

/// What is exported, and to which split each video goes.
struct ExportInput {
  LabelSet set;                       ///< pictures of which have sizes, if the format needs them
  std::vector<std::string> splits;    ///< names; one where no splits are asked for
  std::vector<std::size_t> of_video;  ///< place in `splits` of each video that has pictures
  bool split_asked = false;
};

struct PlannedPicture {
  std::size_t image = 0;  ///< place in the set's images
  std::string to;         ///< relative to the export's folder, "/" between folders
};

struct PlannedText {
  std::string to;
  std::string content;
};

/// All files of an export: each picture that has labels or not, and what is written beside them.
struct ExportPlan {
  std::vector<PlannedPicture> pictures;
  std::vector<PlannedText> texts;
};

/// Where the labels of each image begin; one more entry for the end.
[[nodiscard]] std::vector<std::size_t> first_labels(const LabelSet& set);

/// A name as that of one file or folder: "/" becomes "_".
[[nodiscard]] std::string file_name_of(std::string name);

/// "a/b.png" -> ".png"; empty where there is none.
[[nodiscard]] std::string ending_of(const std::string& file);

/// DataError naming the labels unless all have tracks, none twice in a picture. `format` is who needs that.
void check_tracks(const LabelSet& set, std::string_view format);

/// DataError if a file would come to lie outside the export's folder, or where another does.
void check_targets(const ExportPlan& plan, const LabelSet& set);

}  // namespace thermal
