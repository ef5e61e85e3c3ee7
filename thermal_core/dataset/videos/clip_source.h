#pragma once

#include <string>
#include <vector>

#include "dataset/videos/clip_film.h"

namespace thermal {

/// Selected clips of a dataset.
struct ClipSource {
  FilmedDataset dataset;
  std::vector<std::string> clips;  ///< ids, in the dataset's order or in the requested one; at least one
  bool chosen = false;             ///< by their ids, or by the path of a clip's folder

  /// Clips left out because they are not finished; none if clips were chosen.
  [[nodiscard]] std::vector<std::string> not_made() const;
};

/// `path`: a dataset, or a clip's folder in one (DIR/clips/CLIP). `ids`: clips of the dataset; none: all that are
/// finished. ConfigError "--clips = …" for unknown ids, or for ids together with a clip's folder; DataError if a
/// requested clip, or every clip, is unfinished; errors of read_filmed_dataset().
[[nodiscard]] ClipSource find_clip_source(const Path& path, const std::vector<std::string>& ids);

}  // namespace thermal
