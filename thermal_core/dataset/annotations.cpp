#include "dataset/annotations.h"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "dataset/layout.h"
#include "labels/categories.h"
#include "labels/label_set.h"

namespace thermal {
namespace {

Json category_list(const std::set<std::string>& used) {
  Json list = Json::array();
  std::map<int, std::string> by_id;
  for (const auto& [name, id] : number_categories(used)) {
    if (used.contains(name)) by_id.emplace(id, name);
  }
  for (const auto& [id, name] : by_id) list.push_back({{"id", id}, {"name", name}});
  return list;
}

std::map<int, std::string> size_classes(const Json& annotations) {
  std::map<int, std::pair<double, int>> sums;  // by track: area, boxes
  for (const Json& annotation : annotations) {
    auto& [area, boxes] = sums[annotation["track_id"].get<int>()];
    area += annotation["bbox"][2].get<double>() * annotation["bbox"][3].get<double>();
    ++boxes;
  }
  std::map<int, std::string> classes;
  for (const auto& [track, sum] : sums)
    classes[track] = size_class_name(size_class_of(sum.first / sum.second));
  return classes;
}

/// Rounded, and never "-0.0".
double rounded(double value, double steps_a_unit = 1e4) {
  return std::round(value * steps_a_unit) / steps_a_unit + 0.0;
}

void put(Json& annotation, const char* key, const std::optional<double>& value) {
  if (value) annotation[key] = rounded(*value);
}

Json box_entry(const LabelBox& box) {
  constexpr double kStepsAPixel = 100;
  const double left = rounded(box.x_px, kStepsAPixel);
  const double top = rounded(box.y_px, kStepsAPixel);
  return {left, top, rounded(box.x_px + box.width_px - left, kStepsAPixel),
          rounded(box.y_px + box.height_px - top, kStepsAPixel)};
}

/// What a user projects points of the scene with.
Json camera_entry(const CameraIntrinsics& camera, const LensDistortion& lens) {
  return {{"fx_px", camera.fx_px}, {"fy_px", camera.fy_px}, {"cx_px", camera.cx_px}, {"cy_px", camera.cy_px},
          {"k1", lens.k1},         {"k2", lens.k2},         {"p1", lens.p1},         {"p2", lens.p2}};
}

}  // namespace

ClipAnnotations::ClipAnnotations(const Manifest& manifest, const LensDistortion& lens,
                                 const LabelParameters& parameters)
    : manifest_(manifest), lens_(lens), parameters_(parameters), objects_(kLargestIndex + 1, nullptr) {
  parameters_.validate();
  for (const ManifestObject& object : manifest.objects) {
    if (object.object_class != ObjectClass::actor) continue;
    objects_[object.index] = &object;
    categories_.insert(object.category);
  }
  category_ids_ = number_categories(categories_);
}

void ClipAnnotations::add_frame(int frame, const std::vector<Instance>& instances, bool frozen) {
  const auto at = static_cast<std::size_t>(frame);
  const CameraIntrinsics& camera = manifest_.camera;
  const int image_id = frame + 1;
  images_.push_back({{"id", image_id},
                     {"file_name", "ir8/" + frame_name(frame)},
                     {"width", camera.width_px},
                     {"height", camera.height_px},
                     {"video_id", 1},
                     {"frame_index", frame},
                     {"time_s", manifest_.frames[at].time_s},
                     {"ffc", frozen}});
  for (const Instance& instance : instances)
    annotations_.push_back(annotation_of(instance, image_id, frozen));
}

Json ClipAnnotations::annotation_of(const Instance& instance, int image_id, bool frozen) const {
  const ManifestObject& actor = *objects_[instance.index];
  const PixelBox& box = instance.box;
  Json annotation = {{"id", annotations_.size() + 1},
                     {"image_id", image_id},
                     {"category_id", category_ids_.at(actor.category)},
                     {"bbox",
                      {static_cast<double>(box.x_px), static_cast<double>(box.y_px),
                       static_cast<double>(box.width_px), static_cast<double>(box.height_px)}},
                     {"area", instance.area_px},
                     {"segmentation",
                      {{"size", {manifest_.camera.height_px, manifest_.camera.width_px}},
                       {"counts", encode_coco_rle(instance.mask)}}},
                     {"iscrowd", 0},
                     {"track_id", actor.track_id}};
  if (instance.whole_box) annotation["amodal_bbox"] = box_entry(*instance.whole_box);
  put(annotation, "visibility", instance.visibility);
  if (instance.visibility)
    annotation["occluded"] = *instance.visibility < parameters_.occluded_below_visibility;
  annotation["truncated"] = instance.truncated;
  put(annotation, "truncated_fraction", instance.truncated_fraction);
  put(annotation, "covered_px", instance.covered_px);
  put(annotation, "range_m", instance.range_m);
  put(annotation, "temperature_k", instance.temperature_k);
  put(annotation, "contrast_k", instance.contrast_k);
  put(annotation, "contrast_noise", instance.contrast_noise);
  annotation["noisy"] = frozen;
  annotation["ignore"] = is_ignored(instance, parameters_);
  return annotation;
}

Json ClipAnnotations::document() const {
  const std::map<int, std::string> classes = size_classes(annotations_);
  Json annotations = annotations_;
  for (Json& annotation : annotations) {
    annotation["size_class"] = classes.at(annotation["track_id"].get<int>());
  }
  return {{"info", {{"description", manifest_.clip}, {"version", "1"}}},
          {"categories", category_list(categories_)},
          {"videos", Json::array({{{"id", 1},
                                   {"name", manifest_.clip},
                                   {"width", manifest_.camera.width_px},
                                   {"height", manifest_.camera.height_px},
                                   {"frame_rate_hz", manifest_.frame_rate_hz},
                                   {"frames", images_.size()},
                                   {"camera", camera_entry(manifest_.camera, lens_)}}})},
          {"images", images_},
          {"annotations", std::move(annotations)}};
}

Json join_annotations(const std::string& dataset, const std::vector<std::string>& clips,
                      const std::vector<Json>& documents) {
  std::set<std::string> categories;
  for (const Json& document : documents) {
    for (const Json& category : document.at("categories"))
      categories.insert(category.at("name").get<std::string>());
  }
  const std::map<std::string, int> ids = number_categories(categories);
  Json videos = Json::array();
  Json images = Json::array();
  Json annotations = Json::array();
  for (std::size_t i = 0; i < documents.size(); ++i) {
    const std::size_t images_before = images.size();
    std::map<int, int> new_category;
    for (const Json& category : documents[i].at("categories")) {
      new_category[category.at("id").get<int>()] = ids.at(category.at("name").get<std::string>());
    }
    for (Json video : documents[i].at("videos")) {
      video["id"] = i + 1;
      videos.push_back(std::move(video));
    }
    for (Json image : documents[i].at("images")) {
      image["id"] = images_before + image.at("id").get<std::size_t>();
      image["video_id"] = i + 1;
      image["file_name"] = "clips/" + clips[i] + "/" + image.at("file_name").get<std::string>();
      images.push_back(std::move(image));
    }
    for (Json annotation : documents[i].at("annotations")) {
      annotation["id"] = annotations.size() + 1;
      annotation["image_id"] = images_before + annotation.at("image_id").get<std::size_t>();
      annotation["category_id"] = new_category.at(annotation.at("category_id").get<int>());
      annotations.push_back(std::move(annotation));
    }
  }
  return {{"info", {{"description", dataset}, {"version", "1"}}},
          {"categories", category_list(categories)},
          {"videos", std::move(videos)},
          {"images", std::move(images)},
          {"annotations", std::move(annotations)}};
}

}  // namespace thermal
