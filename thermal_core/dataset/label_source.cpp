#include "dataset/label_source.h"

#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "base/text.h"
#include "dataset/dataset_file.h"
#include "io/json/file.h"
#include "io/label_files/birdsai.h"
#include "io/label_files/coco.h"

namespace thermal {

Path picture_of(const LabelSet& set, const LabelImage& image) {
  const Path plain = Path(image.file).lexically_normal();  // "./a//b.png" is a/b.png
  const auto name = RelativeName::of(plain.string());
  if (!name)
    throw DataError(fault(fmt::format("{}: file_name of image {}", set.name, id_text(image.id)),
                          fmt::format("\"{}\"", image.file), "", RelativeName::kRule));
  Path file = set.root;
  for (const Path& part : plain) {
    file /= part;
    check_is_no_link(file);
  }
  check_is_file(file);
  return file;
}

namespace {

std::vector<std::string> clips_not_made(const Json& record) {
  std::vector<std::string> clips;
  for (const Json& clip : record.at("clips")) {
    if (clip.at("status") != "done") clips.push_back(clip.at("id"));
  }
  return clips;
}

/// annotations.json is complete only after a finished run.
void check_made(const Path& root, const Json& record, bool unfinished_too) {
  if (!record.contains("annotations_sha256")) {
    throw DataError(
        fmt::format("{}: annotations.json may lack clips (a run has not ended, or was killed); expected a "
                    "finished run: run the same command again",
                    root.string()));
  }
  const std::vector<std::string> missing = clips_not_made(record);
  if (missing.empty() || unfinished_too) return;
  throw DataError(
      fmt::format("{} is unfinished: {} of {} clips are missing: {}; expected all of them, or "
                  "--unfinished to accept this",
                  root.string(), missing.size(), record.at("clips").size(), list_names(missing, 8)));
}

LabelSet read_dataset(const Path& root, bool unfinished_too) {
  const Layout layout{root};
  const Json record = read_dataset_file(root);
  try {
    check_made(root, record, unfinished_too);
    LabelSet set = read_coco(layout.annotations_json());
    set.name = record.at("config").at("name");
    return set;
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("{}: {}", layout.dataset_json().string(), error.what()));
  }
}

LabelSet read_any(const Path& source, bool unfinished_too) {
  if (Layout{source}.is_begun()) return read_dataset(source, unfinished_too);
  if (std::filesystem::is_directory(source / "annotations")) return read_birdsai(source);
  if (std::filesystem::is_regular_file(source)) return read_coco(source);
  throw IoError(
      fmt::format("{}{}", source.string(),
                  std::filesystem::exists(source)
                      ? " holds no labels; expected a Veldt dataset (dataset.json), a BIRDSAI folder "
                        "(annotations/*.csv) or a COCO file (.json)"
                      : " does not exist"));
}

}  // namespace

LabelSet read_labels(const Path& source, bool unfinished_too) {
  LabelSet set = read_any(source, unfinished_too);
  assign_size_classes(set);
  return set;
}

}  // namespace thermal
