#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/files.h"

namespace thermal {

/// Frames taken of a video; none where it is left out of the data set that is made.
struct SelectedVideo {
  std::string name;
  std::vector<int> frames;  ///< indices in the video, from 0, ascending
};

struct SelectedDataset {
  std::string path;  ///< as it was given
  std::string name;  ///< of its LabelSet
  std::vector<SelectedVideo> videos;
};

/// What was asked of a class of targets, what is there and what was taken.
struct SelectedClass {
  std::string name;
  std::int64_t at_least = 0;
  std::int64_t at_most = 0;
  std::int64_t available = 0;  ///< labels in all datasets
  std::int64_t taken = 0;
};

/// Which frames of which datasets make a balanced one.
struct Selection {
  std::uint32_t seed = 0;
  std::vector<SelectedClass> classes;
  std::int64_t objective = 0;
  std::int64_t bound = 0;  ///< no selection has a smaller objective
  double gap = 0;          ///< (objective - bound) / max(1, |objective|)
  std::vector<SelectedDataset> datasets;
};

/// Writes it as JSON, atomically; the same selection gives the same bytes. IoError or TryAgainError.
void write_selection(const Path& file, const Selection& selection);

/// DataError naming the file and the place if it is no selection, or one that contradicts itself: frames that are
/// negative, not ascending or twice there, videos or datasets that come twice; IoError if it can't be read.
[[nodiscard]] Selection read_selection(const Path& file);

/// The part of a selection that is about the dataset at `path`, of this name: the one given by the same path, or else
/// the only one of the name. DataError naming `file` if there is none, or several.
[[nodiscard]] const SelectedDataset& selection_for(const Selection& selection, const Path& file,
                                                   const Path& path, const std::string& name);

}  // namespace thermal
