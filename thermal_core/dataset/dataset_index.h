#pragma once

#include <map>
#include <string>
#include <vector>

#include "dataset/clip_record.h"
#include "dataset/layout.h"
#include "imaging/budget.h"
#include "io/config.h"

namespace thermal {

/// The state of a dataset as dataset.json tells it.
struct DatasetIndex {
  Json config;                                 ///< resolved
  Budget budget;                               ///< decided once, for all clips
  std::vector<std::string> clips;              ///< ids, in the config's order
  std::map<std::string, ClipRecord> finished;  ///< by id
  std::map<std::string, std::string> failed;   ///< by id: why
  bool recorded = false;                       ///< the files on disk tell of all the finished clips

  [[nodiscard]] bool complete() const { return finished.size() == clips.size(); }
};

/// Takes up a dataset's folder: finds the clips that are already whole, or starts anew where there is none.
/// ConfigError, listing the keys that differ, if what is there was made from another config.
[[nodiscard]] DatasetIndex open_dataset(const Layout& layout, const Config& config);

/// Writes annotations.json, from the clips that are whole, and dataset.json.
void write_dataset(const Layout& layout, const DatasetIndex& index);

}  // namespace thermal
