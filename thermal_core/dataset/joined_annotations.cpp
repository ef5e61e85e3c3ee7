#include "dataset/joined_annotations.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/clip/annotations.h"
#include "io/json/entry.h"
#include "io/system/files.h"
#include "labels/categories.h"

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

}  // namespace thermal
