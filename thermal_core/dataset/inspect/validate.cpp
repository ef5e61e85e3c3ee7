#include "dataset/inspect/validate.h"

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/clip/record.h"
#include "dataset/dataset_file.h"
#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {
namespace {

/// The fault of a file with changed bytes.
std::string fault_of(const Path& file) {
  if (file.extension() == ".json") {
    try {
      (void)read_json(file);
    } catch (const Error& error) {
      return error.what();  // names file, line and column
    }
  }
  return file.string() + ": changed since it was written";
}

class Checker {
 public:
  Checker(const Path& root, const RunHooks& hooks) : layout_{root}, hooks_(hooks) {}

  DatasetCheck run() {
    const Json dataset = read_dataset_file(layout_.root);
    progress_.total = static_cast<int>(dataset.at("clips").size());
    for (const Json& clip : dataset.at("clips")) {
      check_clip(clip);
      progress_.clip = clip.at("id");
      ++progress_.done;
      hooks_.report(progress_);
    }
    if (dataset.contains("annotations_sha256")) {
      check_file(layout_.annotations_json(), dataset["annotations_sha256"]);
    } else {
      add(layout_.annotations_json(), "may lack clips (a run has not ended, or was killed)");
    }
    return check_;
  }

 private:
  void add(const Path& file, const std::string& what) {
    check_.faults.push_back(file.string() + ": " + what);
  }

  void check_clip(const Json& clip) {
    ++check_.clips;
    const auto id = clip.at("id").get<std::string>();
    const auto status = clip.at("status").get<std::string>();
    const Path folder = layout_.clip(id);
    if (status != "done") {
      add(folder, "not made yet (status " + status + ")");
      return;
    }
    const Path record = folder / "clip.json";
    for (const Path& place : {folder, record})
      check_is_no_link(place);  // read_clip_record() checks the files
    if (!check_file(record, clip.at("record_sha256"))) return;
    for (const auto& [name, sum] : read_clip_record(record).files) check_file(folder / name, sum);
  }

  bool check_file(const Path& file, const std::string& sha256) {
    ++check_.files;
    if (!std::filesystem::exists(file)) {
      add(file, "missing");
      return false;
    }
    if (sha256_of_file(file) == sha256) return true;
    check_.faults.push_back(fault_of(file));
    return false;
  }

  Layout layout_;
  const RunHooks& hooks_;
  Progress progress_;
  DatasetCheck check_;
};

}  // namespace

DatasetCheck validate_dataset(const Path& root, const RunHooks& hooks) { return Checker(root, hooks).run(); }

}  // namespace thermal
