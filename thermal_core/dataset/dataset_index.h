#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dataset/clip/record.h"
#include "dataset/dataset_file.h"
#include "io/config/config.h"
#include "io/json/file.h"
#include "io/system/temporary.h"

namespace thermal {

/// Labels of one clip of a dataset.
struct ClipLabels {
  std::string clip;
  std::string source;  ///< file, for messages
  /// Reads its document like parse_json_elements(); may be called twice.
  std::function<void(const TakeElement& take)> read;
};

/// Joins clips' documents into the dataset's, on one line: ids are renumbered, file names become relative to the
/// dataset's folder, a category keeps its id. `spool` holds annotations while images are written.
void join_annotations(const std::string& dataset, const std::vector<ClipLabels>& clips, Spool spool,
                      const TakeText& take);

/// Writes a dataset's annotations.json: the labels of these complete clips, in this order. In constant memory. Returns
/// the SHA-256 of the file. IoError with a file that cannot be read or written, TryAgainError if the disk is full.
std::string write_joined_annotations(const Layout& layout, const std::string& dataset,
                                     const std::vector<std::string>& clips);

/// Share of a plane's values in a clip that no term can use.
struct UnusableShare {
  std::string clip;
  std::string key;   ///< of dataset.json: unusable_depth_share or unusable_normal_share
  double share = 0;  ///< of the pixels of surfaces, above 0
};

/// The state of a dataset as recorded in dataset.json.
struct DatasetIndex {
  Json config;                                ///< resolved
  Json physics;                               ///< record of the budget, the same for all clips; null if old
  std::vector<std::string> clips;             ///< ids, in the config's order
  std::map<std::string, Json> finished;       ///< by id: its entry; checksums of files stay in clip.json
  std::map<std::string, std::string> failed;  ///< by id: why it failed when last tried
  std::map<std::string, std::vector<SkippedFrame>> skipped = {};  ///< by id: frames that finished clips lack
  std::map<std::string, std::string> made_from_sha256 =
      {};                 ///< by id: the identity of finished clips' passes
  bool recorded = false;  ///< the files on disk list all finished clips

  [[nodiscard]] bool complete() const { return finished.size() == clips.size(); }
  void add(const std::string& id, const ClipRecord& record);

  /// The records of finished clips, among those given, whose passes had unusable depth or normals.
  [[nodiscard]] std::vector<UnusableShare> unusable(const std::vector<std::string>& ids) const;
};

/// Opens a dataset's folder: finds its complete clips, or starts a new one. ConfigError with the keys that differ from
/// another config's dataset.
/// @param document  of the resolved config
/// @param clips  all of its ids
[[nodiscard]] DatasetIndex open_dataset(const Layout& layout, const Json& document,
                                        const std::vector<std::string>& clips);

/// The check alone: ConfigError with the keys that differ if the folder holds a dataset made from another config.
void check_same_dataset(const Layout& layout, const ResolvedConfig& config);

/// Adds progress that other runs have made meanwhile. `own` clips belong to this run, which knows their state.
void catch_up(const Layout& layout, const std::set<std::string>& own, DatasetIndex& index);

/// Writes dataset.json alone. Until write_dataset() it has no checksum of annotations.json, which may lack clips.
void write_progress(const Layout& layout, const DatasetIndex& index);

/// Decides when to write dataset.json during a run: after each clip, but for at most a tenth of the run's time, since
/// the file grows with the number of clips. A killed run loses no work: the next one finds all complete clips.
class ProgressPace {
 public:
  /// Calls `write` unless the last call was too recent.
  template <typename Write>
  void pass(const Write& write) {
    const Clock::time_point begin = Clock::now();
    if (begin < next_) return;
    write();
    const Clock::time_point end = Clock::now();
    next_ = end + kRest * (end - begin);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kRest = 9;  ///< pause in durations of the last call
  Clock::time_point next_;
};

/// Writes annotations.json, from the complete clips, and dataset.json: at the end of a run.
void write_dataset(const Layout& layout, const DatasetIndex& index);

}  // namespace thermal
