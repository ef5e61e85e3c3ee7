#include "dataset/validate.h"

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/clip_record.h"
#include "dataset/layout.h"
#include "io/json_file.h"
#include "io/png.h"
#include "io/sha256.h"

namespace thermal {
namespace {

/// What is wrong with a picture whose bytes have changed.
std::string picture_fault(const Path& file, const std::string& name) {
  try {
    if (name.starts_with("ir16/")) {
      (void)read_png16(file);
    } else {
      (void)read_png8(file);
    }
    return "changed since it was written";
  } catch (const Error&) {
    return "damaged: it cannot be decoded";
  }
}

/// What is wrong with a JSON file whose bytes have changed.
std::string json_fault(const Path& file) {
  try {
    (void)read_json(file);
    return "changed since it was written";
  } catch (const Error& error) {
    const std::string what = error.what();
    return "damaged: " + what.substr(file.string().size());
  }
}

class Checker {
 public:
  explicit Checker(const Path& root) : layout_{root} {}

  DatasetCheck run() {
    const Json dataset = read_json(layout_.dataset_json());
    if (dataset.value("format", "") != "veldt-dataset") {
      throw IoError(layout_.dataset_json().string() + " is not of a Veldt dataset");
    }
    for (const Json& clip : dataset.at("clips")) check_clip(clip);
    check_file(layout_.annotations_json(), "annotations.json", dataset.at("annotations_sha256"));
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
    if (!check_file(record, "clip.json", clip.at("record_sha256"))) return;
    for (const auto& [name, sum] : read_clip_record(record).files) check_file(folder / name, name, sum);
  }

  bool check_file(const Path& file, const std::string& name, const std::string& sha256) {
    ++check_.files;
    if (!std::filesystem::exists(file)) {
      add(file, "missing");
      return false;
    }
    if (sha256_of(read_file(file)) == sha256) return true;
    if (name.ends_with(".png")) {
      add(file, picture_fault(file, name));
    } else if (name.ends_with(".json")) {
      add(file, json_fault(file));
    } else {
      add(file, "changed since it was written");
    }
    return false;
  }

  Layout layout_;
  DatasetCheck check_;
};

}  // namespace

DatasetCheck validate_dataset(const Path& root) { return Checker(root).run(); }

}  // namespace thermal
