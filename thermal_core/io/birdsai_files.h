#pragma once

#include <string>

#include "io/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Labels of a BIRDSAI folder (Bondi et al., WACV 2020): annotations/VIDEO.csv, and images/VIDEO/VIDEO_FRAME.jpg or
/// .png where pictures are there. Rows: frame, object_id, x_min, y_min, w, h, class, species, occluded, noisy;
/// integers, frames and pixels from 0, no header. Frames without a row are there if their picture is.
/// DataError "FILE:LINE: …" for a row that is not that; IoError if there is no annotations folder.
[[nodiscard]] LabelSet read_birdsai(const Path& folder);

/// BIRDSAI's class (0 animal, 1 human) and species of a category; species -1 is unknown.
struct BirdsaiKind {
  int animal_or_human = 0;
  int species = -1;
};
[[nodiscard]] BirdsaiKind birdsai_kind(const std::string& category);

}  // namespace thermal
