#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dataset/dataset_index.h"
#include "io/system/locks.h"

namespace thermal {

/// A run's changes to a dataset's folder: opened, begun, clips committed or rejected, closed. All commands that make
/// datasets use it, and nothing else renames or records a clip. A clip exists completely or not at all, and a run that
/// is killed at any point loses no complete clip: the next one finds it, and removes what is incomplete.
/// commit() and reject() may be called by several threads. All functions may throw an IoError, or a TryAgainError if
/// the disk is full.
class DatasetTransaction {
 public:
  /// Locks the folder, which is created if needed, and reads what is there. TryAgainError if another run has it;
  /// ConfigError if it holds a dataset of another config. Changes nothing yet.
  /// @param document  of the resolved config
  /// @param clips  all of its ids
  /// @param physics  the record of the terms: to_json(Budget)
  /// @param own  the clips that this run makes, while others may make others; empty: all, alone
  DatasetTransaction(const Layout& layout, const Json& document, const std::vector<std::string>& clips,
                     Json physics, const std::optional<std::vector<std::string>>& own = {});

  /// After a fault, without close(): removes incomplete clips and records what was committed. A further fault is not
  /// thrown: the next run detects the missing record, and removes what is left.
  ~DatasetTransaction();
  DatasetTransaction(const DatasetTransaction&) = delete;
  DatasetTransaction& operator=(const DatasetTransaction&) = delete;

  /// The dataset as this run knows it. Not while other threads commit.
  [[nodiscard]] const DatasetIndex& index() const { return index_; }

  /// The folder belongs to this config from here on. Removes what a killed run left of its clips, then calls `also`
  /// while no other run changes files that all of them write.
  void begin(const std::function<void()>& also = {});

  /// Folder to make a clip in: that of ClipTask.
  [[nodiscard]] Path unfinished(const std::string& clip) const { return layout_.unfinished_clip(clip); }

  /// Moves the clip's complete folder to its place, replacing an earlier one, and records it. From a scratch folder,
  /// its files are copied, clip.json last: a clip without that is not complete.
  void commit(const ClipRecord& record);

  /// Records why a clip could not be made, and removes what there is of it.
  void reject(const std::string& clip, const std::string& why);

  /// Writes annotations.json and dataset.json, unless they already list all clips; then calls `also` as begin() does.
  /// Removes what this run, or one that was killed, has left of its clips, also if it did not begin. A scratch folder
  /// belongs to the run, and keeps nothing of any clip of the dataset. Returns what could not be removed.
  [[nodiscard]] std::vector<LeftOver> close(const std::function<void()>& also = {});

 private:
  void change(const std::function<void()>& change);
  void learn();
  void record_all();
  void sweep_half_put() const;
  [[nodiscard]] std::vector<Path> temporary_paths() const;
  std::vector<LeftOver> sweep() const;

  Layout layout_;
  std::set<std::string> own_;  ///< clips that no other run changes
  bool shared_;                ///< other runs may change other clips
  FolderLock lock_;
  DatasetIndex index_;
  bool begun_ = false;
  bool closed_ = false;
  std::mutex mutex_;
  ProgressPace pace_;
};

}  // namespace thermal
