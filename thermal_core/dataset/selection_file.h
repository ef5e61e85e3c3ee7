#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/system/files.h"

namespace thermal {

/// Frames selected from a video; empty if the video is left out of the new data set.
struct SelectedVideo {
  std::string name;
  std::vector<int> frames;  ///< indices in the video, from 0, ascending
};

/// The selected frames of a dataset.
struct SelectedDataset {
  std::string path;  ///< as given
  std::string name;  ///< of its LabelSet
  std::vector<SelectedVideo> videos;
};

/// Requested, available and selected labels of a class of targets.
struct SelectedClass {
  std::string name;
  std::int64_t at_least = 0;
  std::int64_t at_most = 0;
  std::int64_t available = 0;  ///< labels in all datasets
  std::int64_t taken = 0;
};

/// Frames of datasets that form a balanced selection.
struct Selection {
  std::uint32_t seed = 0;
  std::vector<SelectedClass> classes;
  std::int64_t objective = 0;
  std::int64_t bound = 0;  ///< proven lower bound of the objective
  double gap = 0;          ///< (objective - bound) / max(1, |objective|)
  std::vector<SelectedDataset> datasets;
};

/// Writes it as JSON, atomically; the same selection gives the same bytes. IoError or TryAgainError.
void write_selection(const Path& file, const Selection& selection);

/// DataError with the file and the location if it is not a selection, or contradicts itself: frames that are negative,
/// not ascending or repeated, repeated videos or datasets; IoError if it cannot be read.
[[nodiscard]] Selection read_selection(const Path& file);

/// The part of a selection for the dataset at `path`, of this name: the one with the same path, otherwise the only
/// one of that name. DataError with `file` if there is none, or several.
[[nodiscard]] const SelectedDataset& selection_for(const Selection& selection, const Path& file,
                                                   const Path& path, const std::string& name);

}  // namespace thermal
