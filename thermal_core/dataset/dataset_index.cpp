#include "dataset/dataset_index.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/version.h"
#include "dataset/clip/annotations.h"
#include "io/json/entry.h"
#include "io/system/files.h"
#include "io/system/sha256.h"
#include "labels/label_set.h"

namespace thermal {
namespace {

/// Facts about all clips that are needed before the first image is written.
struct Survey {
  std::set<std::string> categories;
  std::vector<std::map<int, std::string>> names;  ///< of a clip's categories, by the clip's ids
  Json videos = Json::array();
};

struct HasSeenEnough {};

/// Adds a clip's lists that precede the images; a document that has them after the images is read to its end.
void survey_clip(const ClipLabels& clip, Survey& survey) {
  std::map<int, std::string>& names = survey.names.emplace_back();
  std::size_t videos = 0;
  const TakeElement take = [&](const std::string& array, std::size_t place, const Json& element) {
    if (array == "categories") {
      const JsonEntry category(element, clip.source, array, place);
      names[category.count("id")] = category.text("name");
    }
    if (array == "videos") {
      survey.videos.push_back(element);
      survey.videos.back()["id"] = survey.names.size();
      ++videos;
    }
    if (array == "images" && videos > 0 && !names.empty()) throw HasSeenEnough();
  };
  try {
    clip.read(take);
  } catch (const HasSeenEnough&) {
  }
  for (const auto& [id, name] : names) survey.categories.insert(name);
}

Survey look_at_all(const std::vector<ClipLabels>& clips) {
  Survey survey;
  for (const ClipLabels& clip : clips) survey_clip(clip, survey);
  return survey;
}

/// Numbers images and annotations across all clips.
class Joiner {
 public:
  Joiner(const Survey& survey, Spool spool, JsonStream& document)
      : survey_(survey),
        ids_(number_categories(survey.categories)),
        spool_(std::move(spool)),
        document_(document) {}

  void join(const std::vector<ClipLabels>& clips) {
    document_.begin_array("images");
    for (std::size_t i = 0; i < clips.size(); ++i) add(clips[i], i);
    document_.begin_array("annotations");
    spool_.read([this](std::string_view line) { document_.add(line); });
  }

 private:
  void add(const ClipLabels& clip, std::size_t number) {
    const std::size_t images_before = last_image_;
    clip.read([&](const std::string& array, std::size_t place, const Json& element) {
      const JsonEntry entry(element, clip.source, array, place);
      if (array == "images") add_image(element, entry, images_before, number, clip.clip);
      if (array == "annotations") add_annotation(element, entry, images_before, survey_.names[number]);
    });
  }

  /// A clip with skipped frames has gaps in its ids, so the last id is used, not the number of images.
  void add_image(Json image, const JsonEntry& given, std::size_t before, std::size_t number,
                 const std::string& clip) {
    const std::size_t id = before + static_cast<std::size_t>(given.count("id"));
    last_image_ = std::max(last_image_, id);
    image["id"] = id;
    image["video_id"] = number + 1;
    image["file_name"] = "clips/" + clip + "/" + given.text("file_name");
    document_.add(image.dump());
  }

  void add_annotation(Json annotation, const JsonEntry& given, std::size_t images_before,
                      const std::map<int, std::string>& names) {
    const auto category = names.find(given.count("category_id"));
    if (category == names.end()) throw given.fault_of("category_id", "the id of one of its categories");
    annotation["id"] = ++annotations_;
    annotation["image_id"] = images_before + static_cast<std::size_t>(given.count("image_id"));
    annotation["category_id"] = ids_.at(category->second);
    spool_.add(annotation.dump());
  }

  const Survey& survey_;
  std::map<std::string, int> ids_;  ///< of categories, in the dataset
  Spool spool_;
  JsonStream& document_;
  std::size_t last_image_ = 0;
  std::size_t annotations_ = 0;
};

ClipLabels labels_of(const Layout& layout, const std::string& clip) {
  const Path file = layout.clip(clip) / "labels.json";
  return {.clip = clip, .source = file.string(), .read = [file](const TakeElement& take) {
            try {
              (void)read_json_elements(file, take);
            } catch (const Json::exception& error) {
              throw DataError(fmt::format("{}: not labels of a clip: {}", file.string(), error.what()));
            }
          }};
}

/// Always the same, so that leftovers of a killed run are overwritten.
Path beside(const Path& file, const char* ending) {
  Path name = file;
  name += ending;
  return name;
}

}  // namespace

void join_annotations(const std::string& dataset, const std::vector<ClipLabels>& clips, Spool spool,
                      const TakeText& take) {
  const Survey survey = look_at_all(clips);
  JsonStream document({{"info", {{"description", dataset}, {"version", "1"}}},
                       {"categories", category_list(survey.categories)},
                       {"videos", survey.videos}},
                      JsonLayout::compact, take);
  Joiner(survey, std::move(spool), document).join(clips);
  document.end();
}

std::string write_joined_annotations(const Layout& layout, const std::string& dataset,
                                     const std::vector<std::string>& clips) {
  std::vector<ClipLabels> labels;
  for (const std::string& clip : clips) labels.push_back(labels_of(layout, clip));
  const Path file = layout.annotations_json();
  const Path work = layout.workplace() / file.filename();
  OutputFile out(beside(work, ".tmp"));
  join_annotations(dataset, labels, Spool(beside(work, ".spool")),
                   [&out](std::string_view text) { out.add(text); });
  return out.close_as(file);
}

namespace {

void check_same_config(const Layout& layout, const Json& document, const Json& there) {
  const Json recorded = there.value("config", Json::object());
  const std::vector<std::string> found = differences(document, recorded);
  if (found.empty()) return;
  constexpr std::size_t kMost = 8;
  throw ConfigError(
      fmt::format("{} holds a dataset made from another config: {}; expected {}, or another folder",
                  layout.root.string(), list_names(found, kMost), expected_config(document, recorded)));
}

/// The dataset that a run continues. ConfigError if the folder holds anything else.
Json read_started(const Layout& layout) {
  try {
    return read_dataset_file(layout.root);
  } catch (const DataError& fault) {
    throw ConfigError(fault.what());
  }
}

/// False if a run was killed between renaming a clip and recording it, or before joining the labels.
bool is_recorded(const Layout& layout, const DatasetIndex& index, const Json& there) {
  if (!there.contains("annotations_sha256")) return false;
  for (const Json& clip : there.at("clips")) {
    const bool recorded = clip.at("status") == "done";
    if (recorded != index.finished.contains(clip.at("id").get<std::string>())) return false;
  }
  return std::filesystem::exists(layout.annotations_json());
}

Json clip_entry(const DatasetIndex& index, const std::string& id) {
  if (const auto done = index.finished.find(id); done != index.finished.end()) return done->second;
  if (const auto why = index.failed.find(id); why != index.failed.end()) {
    return {{"id", id}, {"status", "failed"}, {"reason", why->second}};
  }
  return {{"id", id}, {"status", "pending"}};
}

std::map<std::string, std::string> failed_there(const Json& there) {
  std::map<std::string, std::string> failed;
  for (const Json& clip : there.at("clips")) {
    if (clip.at("status") == "failed") failed[clip.at("id")] = clip.at("reason");
  }
  return failed;
}

/// Complete clips that are not recorded.
void find_finished(const Layout& layout, DatasetIndex& index) {
  for (const std::string& id : index.clips) {
    const Path record = layout.clip(id) / "clip.json";
    if (!index.finished.contains(id) && std::filesystem::exists(record))
      index.add(id, read_clip_record(record));
  }
}

/// dataset.json; `annotations_sha256` is empty while annotations.json may lack clips.
Json document_of(const DatasetIndex& index, const std::string& annotations_sha256) {
  Json clips = Json::array();
  std::int64_t frames = 0;
  std::int64_t annotations = 0;
  Sha256 pixels;
  for (const std::string& id : index.clips) {
    clips.push_back(clip_entry(index, id));
    if (!index.finished.contains(id)) continue;
    frames += clips.back()["frames"].get<int>();
    annotations += clips.back()["annotations"].get<int>();
    pixels.add(clips.back()["pixels_sha256"].get<std::string>());
  }
  Json document = {{"format", "veldt-dataset"},
                   {"version", 1},
                   {"veldt_version", kVersion},
                   {"status", index.complete() ? "complete" : "unfinished"},
                   {"frames", frames},
                   {"annotations", annotations},
                   {"pixels_sha256", pixels.hex()}};
  if (!annotations_sha256.empty()) document["annotations_sha256"] = annotations_sha256;
  document["kelvin_per_count"] = index.config.at("sensor").at("kelvin_per_count");
  if (!index.physics.is_null()) document["physics"] = index.physics;
  document["clips"] = std::move(clips);
  document["config"] = index.config;
  return document;
}

/// In the config's order.
std::vector<std::string> finished_clips(const DatasetIndex& index) {
  std::vector<std::string> clips;
  for (const std::string& id : index.clips) {
    if (index.finished.contains(id)) clips.push_back(id);
  }
  return clips;
}

}  // namespace

void DatasetIndex::add(const std::string& id, const ClipRecord& record) {
  finished[id] = {{"id", id},
                  {"status", "done"},
                  {"season", record.season},
                  {"frames", record.frames},
                  {"annotations", record.annotations},
                  {"pixels_sha256", record.pixels_sha256},
                  {"record_sha256", sha256_of(to_text(to_json(record)))}};
  add_unusable(record, finished[id]);
  if (!record.skipped.empty()) finished[id]["skipped"] = record.skipped.size();
  skipped[id] = record.skipped;
  made_from_sha256[id] = record.made_from_sha256;
  failed.erase(id);
}

std::vector<UnusableShare> DatasetIndex::unusable(const std::vector<std::string>& ids) const {
  std::vector<UnusableShare> shares;
  for (const std::string& id : ids) {
    const auto found = finished.find(id);
    if (found == finished.end()) continue;
    for (const char* key : {"unusable_depth_share", "unusable_normal_share"}) {
      if (const double share = found->second.value(key, 0.0); share > 0)
        shares.push_back({.clip = id, .key = key, .share = share});
    }
  }
  return shares;
}

void check_same_dataset(const Layout& layout, const ResolvedConfig& config) {
  if (layout.is_begun()) check_same_config(layout, config.document, read_started(layout));
}

DatasetIndex open_dataset(const Layout& layout, const Json& document, const std::vector<std::string>& clips) {
  DatasetIndex index{.config = document, .physics = {}, .clips = clips, .finished = {}, .failed = {}};
  const bool begun = layout.is_begun();
  const Json there = begun ? read_started(layout) : Json();
  if (begun) check_same_config(layout, document, there);
  if (begun) index.failed = failed_there(there);
  find_finished(layout, index);
  index.recorded = begun && is_recorded(layout, index, there);
  return index;
}

void catch_up(const Layout& layout, const std::set<std::string>& own, DatasetIndex& index) {
  find_finished(layout, index);
  std::erase_if(index.failed, [&own](const auto& failed) { return !own.contains(failed.first); });
  for (const auto& [id, why] : failed_there(read_dataset_file(layout.root))) {
    if (!own.contains(id) && !index.finished.contains(id)) index.failed[id] = why;
  }
}

void write_progress(const Layout& layout, const DatasetIndex& index) {
  write_file_atomically(layout.dataset_json(), to_text(document_of(index, "")));
}

void write_dataset(const Layout& layout, const DatasetIndex& index) {
  const std::string annotations_sha256 =
      write_joined_annotations(layout, index.config.at("name"), finished_clips(index));
  write_file_atomically(layout.dataset_json(), to_text(document_of(index, annotations_sha256)));
}

}  // namespace thermal
