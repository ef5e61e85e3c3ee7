#include "dataset/exports/coco.h"

#include <filesystem>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "io/json/entry.h"
#include "io/json/file.h"

namespace thermal {
namespace {

/// Writes the files of the splits, list by list, while one large file is read.
class Splitter {
 public:
  explicit Splitter(const ExportInput& input, SegmentMaker* segments)
      : input_(input), segments_(segments), lists_(input.splits.size()), videos_(input.splits.size()) {
    for (std::size_t i = 0; i < input.set.images.size(); ++i) images_.emplace(input.set.images[i].id, i);
    if (!input.boxes_changed) return;
    for (const Label& label : input.set.labels) boxes_.emplace(label.id, label.box);
  }

  std::vector<std::string> split(const std::string& text, const std::string& name) {
    const Json rest = parse_json_elements(
        text, name,
        [this](const std::string& list, std::size_t, const Json& element) { take(list, element); });
    std::vector<std::string> files;
    for (std::size_t split = 0; split < input_.splits.size(); ++split) {
      add_videos(split);
      files.push_back(file_of(split, rest));
    }
    return files;
  }

 private:
  void take(const std::string& list, const Json& element) {
    if (list == "images") {
      take_image(element);
    } else if (list == "annotations") {
      take_annotation(element);
    } else if (list == "videos") {
      all_videos_.push_back(element);
    } else {
      for (std::size_t split = 0; split < lists_.size(); ++split) add(split, list, element);
    }
  }

  void take_annotation(const Json& element) {
    const auto image = images_.find(label_id_in(element.at("image_id")));
    if (image == images_.end()) return;
    const std::size_t split = split_of(image->second);
    const bool is_empty = element.value("bbox", Json()).is_null();  // an empty picture's annotation
    if (is_empty || (!input_.boxes_changed && segments_ == nullptr))
      return add(split, "annotations", element);
    Json annotation = element;
    if (input_.boxes_changed) annotation["bbox"] = bbox_of(boxes_.at(label_id_in(element.at("id"))));
    if (segments_ != nullptr) annotation["segmentation"] = segments_->segmentation_of(element);
    add(split, "annotations", annotation);
  }

  void take_image(const Json& element) {
    const auto found = images_.find(label_id_in(element.at("id")));
    if (found == images_.end()) return;
    Json image = element;
    image["file_name"] = input_.set.images[found->second].file;
    const std::size_t split = split_of(found->second);
    add(split, "images", image);
    if (const Json& video = image.value("video_id", Json()); !video.is_null())
      videos_[split].insert(label_id_in(video));
  }

  [[nodiscard]] std::size_t split_of(std::size_t image) const {
    return input_.of_video[input_.set.images[image].video];
  }

  void add(std::size_t split, const std::string& list, const Json& element) {
    std::string& text = lists_[split][list];
    if (!text.empty()) text += ',';
    text += element.dump();
  }

  void add_videos(std::size_t split) {
    for (const Json& video : all_videos_)
      if (videos_[split].contains(label_id_in(video.at("id")))) add(split, "videos", video);
  }

  /// Keys in the order of the file read; its lists are empty in `rest`.
  std::string file_of(std::size_t split, const Json& rest) {
    std::string text = "{";
    for (const auto& [key, value] : rest.items()) {
      if (text.size() > 1) text += ',';
      text += Json(key).dump() + ":";
      text += value.is_array() ? "[" + std::exchange(lists_[split][key], "") + "]" : value.dump();
    }
    return text + "}\n";
  }

  const ExportInput& input_;
  SegmentMaker* segments_;                                 ///< null: masks are unchanged
  std::unordered_map<LabelId, std::size_t> images_;        ///< index in the set, by id
  std::unordered_map<LabelId, LabelBox> boxes_;            ///< those that changed, by the label's id
  std::vector<std::map<std::string, std::string>> lists_;  ///< by split and key
  std::vector<std::set<LabelId>> videos_;                  ///< ids with images, by split
  std::vector<Json> all_videos_;
};

Json annotation_of(const LabelSet& set, const Label& label) {
  Json json = {{"id", json_of(label.id)},
               {"image_id", json_of(set.images[label.image].id)},
               {"category_id", json_of(set.categories[label.category].id)},
               {"bbox", bbox_of(label.box)},
               {"area", label.area_px},
               {"iscrowd", label.crowd ? 1 : 0}};
  if (label.track_id) json["track_id"] = *label.track_id;
  if (label.occluded) json["occluded"] = *label.occluded;
  json["noisy"] = label.noisy;
  json["ignore"] = label.ignore;
  json["size_class"] = size_class_name(label.size);
  return json;
}

Json image_of(const LabelImage& image) {
  return {{"id", json_of(image.id)},   {"file_name", image.file},     {"width", image.width_px},
          {"height", image.height_px}, {"video_id", image.video + 1}, {"frame_index", image.frame_index}};
}

}  // namespace

Json bbox_of(const LabelBox& box) { return {box.x_px, box.y_px, box.width_px, box.height_px}; }

std::string coco_text(const LabelSet& set) {
  Json document = {{"info", {{"description", set.name}, {"version", "1"}}}};
  for (const char* list : {"categories", "videos", "images", "annotations"}) document[list] = Json::array();
  for (const LabelCategory& category : set.categories)
    document["categories"].push_back({{"id", json_of(category.id)}, {"name", category.name}});
  for (std::size_t i = 0; i < set.videos.size(); ++i)
    document["videos"].push_back({{"id", i + 1}, {"name", set.videos[i].name}});
  for (const LabelImage& image : set.images) document["images"].push_back(image_of(image));
  for (const Label& label : set.labels) document["annotations"].push_back(annotation_of(set, label));
  return document.dump() + "\n";
}

std::vector<std::string> split_coco(const ExportInput& input, const std::string& text,
                                    const std::string& name, SegmentMaker* segments) {
  return Splitter(input, segments).split(text, name);
}

ExportPlan plan_coco(const ExportInput& input, const std::string& text, const std::string& name, bool as_is,
                     SegmentMaker* segments) {
  ExportPlan plan;
  for (std::size_t i = 0; i < input.set.images.size(); ++i)
    plan.pictures.push_back(
        {.image = i, .to = std::filesystem::path(input.set.images[i].file).lexically_normal().string()});
  std::vector<std::string> files;
  if (!as_is || segments != nullptr) files = split_coco(input, text, name, segments);
  if (as_is && (segments == nullptr || !segments->has_changed())) files = {text};
  for (std::size_t split = 0; split < files.size(); ++split)
    plan.texts.push_back(
        {.to = input.split_asked ? "annotations/" + input.splits[split] + ".json" : "annotations.json",
         .content = std::move(files[split])});
  return plan;
}

}  // namespace thermal
