#include "dataset/run/transaction.h"

#include <exception>
#include <utility>

#include "base/text.h"
#include "dataset/run/options.h"

namespace thermal {

DatasetTransaction::DatasetTransaction(const Layout& layout, const Json& document,
                                       const std::vector<std::string>& clips, Json physics,
                                       const std::optional<std::vector<std::string>>& own)
    : layout_(layout),
      own_(own ? own->begin() : clips.begin(), own ? own->end() : clips.end()),
      shared_(own.has_value()),
      lock_(shared_ && layout.scratch.empty() ? FolderLock(layout.root, places_of(*own, clips))
                                              : FolderLock(layout.workplace())) {
  lock_.in_turn([&] { index_ = open_dataset(layout_, document, clips); });
  index_.physics = std::move(physics);
}

DatasetTransaction::~DatasetTransaction() {
  if (!begun_ || closed_) return;
  try {
    (void)sweep();
    record_all();
  } catch (const std::exception&) {  // must not hide the fault that ended the run
  }
}

void DatasetTransaction::begin(const std::function<void()>& also) {
  check_is_no_link(layout_.clips());
  lock_.in_turn([&] {
    make_folder(layout_.root);
    (void)sweep();
    sweep_half_put();
    for (const std::string& clip : own_) index_.failed.erase(clip);
    write_progress(layout_, index_);
    if (also) also();
    begun_ = true;
  });
}

void DatasetTransaction::commit(const ClipRecord& record) {
  const Path path = layout_.clip(record.clip);
  if (layout_.scratch.empty())
    replace_folder(unfinished(record.clip), path);
  else
    put_folder(unfinished(record.clip), path, "clip.json");
  change([&] { index_.add(record.clip, record); });
}

void DatasetTransaction::reject(const std::string& clip, const std::string& why) {
  (void)sweep_folder(unfinished(clip));
  change([&] { index_.failed[clip] = printable(why); });
}

std::vector<LeftOver> DatasetTransaction::close(const std::function<void()>& also) {
  if (begun_ || !index_.recorded) record_all();
  closed_ = true;
  if (also) lock_.in_turn(also);
  return sweep();
}

/// Writes dataset.json now and then only: see ProgressPace.
void DatasetTransaction::change(const std::function<void()>& change) {
  const std::lock_guard lock(mutex_);
  change();
  pace_.pass([this] {
    lock_.in_turn([this] {
      learn();
      write_progress(layout_, index_);
    });
  });
}

/// What other runs have made meanwhile. Call in turn.
void DatasetTransaction::learn() {
  if (shared_ && layout_.is_begun()) catch_up(layout_, own_, index_);
}

void DatasetTransaction::record_all() {
  lock_.in_turn([this] {
    learn();
    write_dataset(layout_, index_);
  });
}

/// Clips that a killed run began to put into the folder.
void DatasetTransaction::sweep_half_put() const {
  for (const std::string& clip : own_)
    if (!index_.finished.contains(clip)) (void)sweep_folder(layout_.clip(clip));
}

std::vector<Path> DatasetTransaction::temporary_paths() const {
  std::vector<Path> paths;
  if (layout_.scratch.empty()) {
    for (const std::string& clip : own_) paths.push_back(unfinished(clip));
    return paths;
  }
  for (const std::string& clip : index_.clips) paths.push_back(unfinished(clip));
  for (const char* ending : {".tmp", ".spool"})
    paths.push_back(layout_.scratch / (layout_.annotations_json().filename().string() + ending));
  return paths;
}

std::vector<LeftOver> DatasetTransaction::sweep() const {
  std::vector<LeftOver> left_over;
  std::error_code error;
  if (std::filesystem::is_symlink(layout_.clips(), error)) return left_over;  // nothing elsewhere is removed
  for (const Path& path : temporary_paths())
    if (auto left = sweep_folder(path)) left_over.push_back(*std::move(left));
  return left_over;
}

}  // namespace thermal
