#include "dataset/annotations.h"

#include <map>
#include <set>

#include "dataset/layout.h"
#include "labels/categories.h"

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

std::string size_class(double box_area_px) {
  constexpr double kSmallBelow = 200;
  constexpr double kLargeAbove = 2000;
  if (box_area_px < kSmallBelow) return "small";
  return box_area_px > kLargeAbove ? "large" : "medium";
}

std::map<int, std::string> size_classes(const Json& annotations) {
  std::map<int, std::pair<double, int>> sums;  // by track: area, boxes
  for (const Json& annotation : annotations) {
    auto& [area, boxes] = sums[annotation["track_id"].get<int>()];
    area += annotation["bbox"][2].get<double>() * annotation["bbox"][3].get<double>();
    ++boxes;
  }
  std::map<int, std::string> classes;
  for (const auto& [track, sum] : sums) classes[track] = size_class(sum.first / sum.second);
  return classes;
}

/// What a user projects points of the scene with.
Json camera_entry(const CameraIntrinsics& camera, const LensDistortion& lens) {
  return {{"fx_px", camera.fx_px}, {"fy_px", camera.fy_px}, {"cx_px", camera.cx_px}, {"cy_px", camera.cy_px},
          {"k1", lens.k1},         {"k2", lens.k2},         {"p1", lens.p1},         {"p2", lens.p2}};
}

}  // namespace

ClipAnnotations::ClipAnnotations(const Manifest& manifest, const LensDistortion& lens)
    : manifest_(manifest), lens_(lens), objects_(kLargestIndex + 1, nullptr) {
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
  for (const Instance& instance : instances) {
    const ManifestObject& actor = *objects_[instance.index];
    const PixelBox& box = instance.box;
    annotations_.push_back(
        {{"id", annotations_.size() + 1},
         {"image_id", image_id},
         {"category_id", category_ids_.at(actor.category)},
         {"bbox",
          {static_cast<double>(box.x_px), static_cast<double>(box.y_px), static_cast<double>(box.width_px),
           static_cast<double>(box.height_px)}},
         {"area", instance.area_px},
         {"segmentation",
          {{"size", {camera.height_px, camera.width_px}}, {"counts", encode_coco_rle(instance.mask)}}},
         {"iscrowd", 0},
         {"track_id", actor.track_id},
         {"truncated", instance.truncated},
         {"noisy", frozen}});
  }
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
          {"annotations", annotations}};
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
