#pragma once

#include <string>

#include "io/system/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Reads labels from a BIRDSAI folder (Bondi et al., WACV 2020): annotations/VIDEO.csv and, if present, pictures
/// images/VIDEO/VIDEO_FRAME.jpg or .png. Rows: frame, object_id, x_min, y_min, w, h, class, species, occluded, noisy;
/// integers, frames and pixels from 0, object_id of 64 bits, no header. All columns are used; there are no others.
/// Frames without a row are included if their picture exists. Other files in the folders are ignored.
/// DataError "FILE:LINE: …" for an invalid row, and for two pictures of one frame; IoError without an annotations
/// folder.
[[nodiscard]] LabelSet read_birdsai(const Path& folder);

/// BIRDSAI's class (0 animal, 1 human) and species of a category; species -1 is unknown.
struct BirdsaiKind {
  int animal_or_human = 0;
  int species = -1;
};
/// BIRDSAI's numbers of a category.
[[nodiscard]] BirdsaiKind birdsai_kind(const std::string& category);

}  // namespace thermal
