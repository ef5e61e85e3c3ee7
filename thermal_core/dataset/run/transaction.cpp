#include "dataset/run/transaction.h"

#include <exception>
#include <utility>

#include "base/printable.h"
#include "dataset/run/clip_choice.h"

namespace thermal {
namespace {

std::set<std::string> set_of(const std::vector<std::string>& ids) { return {ids.begin(), ids.end()}; }

}  // namespace

DatasetTransaction::DatasetTransaction(const Layout& layout, const Config& config, Json physics)
    : DatasetTransaction(layout, config, std::move(physics), config.clips, false) {}

DatasetTransaction::DatasetTransaction(const Layout& layout, const Config& config, Json physics,
                                       const std::vector<ClipConfig>& clips)
    : DatasetTransaction(layout, config, std::move(physics), clips, true) {}

DatasetTransaction::DatasetTransaction(const Layout& layout, const Config& config, Json physics,
                                       const std::vector<ClipConfig>& clips, bool shared)
    : layout_(layout),
      own_(set_of(ids_of(clips))),
      shared_(shared),
      lock_(shared && layout.scratch.empty() ? FolderLock(layout.root, places_of(config, clips))
                                             : FolderLock(layout.workplace())) {
  lock_.in_turn([&] { index_ = open_dataset(layout_, config); });
  index_.physics = std::move(physics);
}

DatasetTransaction::~DatasetTransaction() {
  if (!begun_) return;
  sweep();
  if (closed_) return;
  try {
    record_all();
  } catch (const std::exception&) {  // must not hide the fault that ended the run
  }
}

void DatasetTransaction::begin(const std::function<void()>& also) {
  check_is_no_link(layout_.clips());
  lock_.in_turn([&] {
    make_folder(layout_.root);
    sweep();
    sweep_half_put();
    for (const std::string& clip : own_) index_.failed.erase(clip);
    write_progress(layout_, index_);
    if (also) also();
    begun_ = true;
  });
}

void DatasetTransaction::commit(const ClipRecord& record) {
  const Path place = layout_.clip(record.clip);
  if (layout_.scratch.empty())
    replace_folder(unfinished(record.clip), place);
  else
    put_folder(unfinished(record.clip), place, "clip.json");
  change([&] { index_.add(record.clip, record); });
}

void DatasetTransaction::reject(const std::string& clip, const std::string& why) {
  sweep_folder(unfinished(clip));
  change([&] { index_.failed[clip] = printable(why); });
}

void DatasetTransaction::close(const std::function<void()>& also) {
  if (begun_ || !index_.recorded) record_all();
  closed_ = true;
  if (also) lock_.in_turn(also);
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
void DatasetTransaction::sweep_half_put() noexcept {
  for (const std::string& clip : own_)
    if (!index_.finished.contains(clip)) sweep_folder(layout_.clip(clip));
}

void DatasetTransaction::sweep() noexcept {
  for (const std::string& clip : own_) sweep_folder(unfinished(clip));
}

}  // namespace thermal
