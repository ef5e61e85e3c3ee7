#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "dataset/clip_record.h"
#include "dataset/layout.h"
#include "io/config.h"

namespace thermal {

/// The state of a dataset as dataset.json tells it.
struct DatasetIndex {
  Json config;                           ///< resolved
  Json physics;                          ///< what is told of the budget, which is one for all clips
  std::vector<std::string> clips;        ///< ids, in the config's order
  std::map<std::string, Json> finished;  ///< by id: what is told of it; the files' sums stay in clip.json
  std::map<std::string, std::string> failed;                      ///< by id: why, when it was last tried
  std::map<std::string, std::vector<SkippedFrame>> skipped = {};  ///< by id: frames finished clips go without
  bool recorded = false;  ///< the files on disk tell of all the finished clips

  [[nodiscard]] bool complete() const { return finished.size() == clips.size(); }
  void add(const std::string& id, const ClipRecord& record);
};

/// Takes up a dataset's folder: finds the clips that are already whole, or starts anew where there is none.
/// ConfigError, listing the keys that differ, if what is there was made from another config.
[[nodiscard]] DatasetIndex open_dataset(const Layout& layout, const Config& config);

/// Takes in what other runs have made of the dataset meanwhile. Of `own` clips, which are this run's alone, it has
/// tried what it could itself.
void catch_up(const Layout& layout, const std::set<std::string>& own, DatasetIndex& index);

/// Writes dataset.json alone, as a run goes on: little work however many clips there are. Until write_dataset()
/// it has no sum of annotations.json, which may lack clips.
void write_progress(const Layout& layout, const DatasetIndex& index);

/// Writes annotations.json, from the clips that are whole, and dataset.json: at the end of a run.
void write_dataset(const Layout& layout, const DatasetIndex& index);

/// The same where a fault ends the run: one more, such as a full disk, must not hide the first.
void write_dataset_after_fault(const Layout& layout, const DatasetIndex& index) noexcept;

}  // namespace thermal
