#include "dataset/clip/annotations.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "dataset/dataset_file.h"
#include "io/json/camera.h"
#include "labels/label_set.h"

namespace thermal {
namespace {

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

/// What a user needs to project points of the scene; OpenCV's principal point is 0.5 px less.
Json camera_entry(const CameraIntrinsics& camera, const LensDistortion& lens) {
  Json entry = to_json(camera);
  entry.erase("width_px");
  entry.erase("height_px");
  entry.update(to_json(lens));
  return entry;
}

}  // namespace

ClipAnnotations::ClipAnnotations(const Manifest& manifest, const LensDistortion& lens,
                                 const LabelParameters& parameters, const Path& spool)
    : manifest_(manifest),
      lens_(lens),
      parameters_(parameters),
      objects_(kIndexValues, nullptr),
      annotations_(spool) {
  parameters_.validate();
  for (const ManifestObject& object : manifest.objects) {
    if (object.object_class != ObjectClass::actor) continue;
    objects_[object.index] = &object;
    categories_.insert(object.category);
  }
  category_ids_ = number_categories(categories_);
}

void ClipAnnotations::add_frame(int frame, const std::vector<Instance>& instances, bool frozen) {
  images_.push_back({.frame = frame, .frozen = frozen});
  for (const Instance& instance : instances) {
    const Json annotation = annotation_of(instance, frame + 1, frozen);
    const int track = objects_[instance.index]->track_id;
    annotations_.add(element_text(annotation, JsonLayout::indented));
    annotations_.add(std::to_string(track));
    Boxes& boxes = tracks_[track];
    boxes.area_px += static_cast<double>(instance.box.width_px) * static_cast<double>(instance.box.height_px);
    ++boxes.count;
    ++count_;
  }
}

Json ClipAnnotations::annotation_of(const Instance& instance, int image_id, bool frozen) const {
  const ManifestObject& actor = *objects_[instance.index];
  Json annotation = {
      {"id", count_ + 1}, {"image_id", image_id}, {"category_id", category_ids_.at(actor.category)}};
  annotation.update(label_entry(instance, actor, manifest_.camera, parameters_, frozen));
  return annotation;
}

Json ClipAnnotations::head() const {
  return {{"info", {{"description", manifest_.clip}, {"version", "1"}}},
          {"categories", category_list(categories_)},
          {"videos", Json::array({{{"id", 1},
                                   {"name", manifest_.clip},
                                   {"width", manifest_.camera.width_px},
                                   {"height", manifest_.camera.height_px},
                                   {"frame_rate_hz", manifest_.frame_rate_hz},
                                   {"frames", images_.size()},
                                   {"camera", camera_entry(manifest_.camera, lens_)}}})}};
}

Json ClipAnnotations::image_entry(const Image& image) const {
  return {{"id", image.frame + 1},
          {"file_name", "ir8/" + frame_name(image.frame)},
          {"width", manifest_.camera.width_px},
          {"height", manifest_.camera.height_px},
          {"video_id", 1},
          {"frame_index", image.frame},
          {"time_s", manifest_.frames[static_cast<std::size_t>(image.frame)].time_s},
          {"ffc", image.frozen}};
}

void ClipAnnotations::write(const TakeText& take) {
  JsonStream document(head(), JsonLayout::indented, take);
  document.begin_array("images");
  for (const Image& image : images_) document.add(element_text(image_entry(image), JsonLayout::indented));
  document.begin_array("annotations");
  write_annotations(document);
  document.end();
}

/// Replaces the closing brace by the size class, which is known only at the end of the clip.
void ClipAnnotations::write_annotations(JsonStream& document) {
  constexpr std::string_view kEnd = "\n    }\n";
  std::string text;
  annotations_.read([&](std::string_view line) {
    if (line.starts_with(' ') || line.starts_with('{')) {
      text.append(line).push_back('\n');
      return;
    }
    const Boxes& boxes = tracks_.at(std::stoi(std::string(line)));
    text.resize(text.size() - kEnd.size());
    text += fmt::format(",\n      \"size_class\": \"{}\"\n    }}",
                        size_class_name(size_class_of(boxes.area_px / boxes.count)));
    document.add(text);
    text.clear();
  });
}

Json label_entry(const Instance& instance, const ManifestObject& actor, const CameraIntrinsics& camera,
                 const LabelParameters& parameters, bool frozen) {
  const PixelBox& box = instance.box;
  Json entry = {{"bbox",
                 {static_cast<double>(box.x_px), static_cast<double>(box.y_px),
                  static_cast<double>(box.width_px), static_cast<double>(box.height_px)}},
                {"area", instance.area_px},
                {"segmentation",
                 {{"size", {camera.height_px, camera.width_px}}, {"counts", encode_coco_rle(instance.mask)}}},
                {"iscrowd", 0},
                {"track_id", actor.track_id}};
  if (instance.whole_box) entry["amodal_bbox"] = box_entry(*instance.whole_box);
  put(entry, "visibility", instance.visibility);
  if (instance.visibility) entry["occluded"] = *instance.visibility < parameters.occluded_below_visibility;
  entry["truncated"] = instance.truncated;
  put(entry, "truncated_fraction", instance.truncated_fraction);
  put(entry, "covered_px", instance.covered_px);
  put(entry, "range_m", instance.range_m);
  put(entry, "temperature_k", instance.temperature_k);
  put(entry, "contrast_k", instance.contrast_k);
  put(entry, "contrast_noise", instance.contrast_noise);
  entry["noisy"] = frozen;
  entry["ignore"] = is_ignored(instance, parameters);
  return entry;
}

Json category_list(const std::set<std::string>& used) {
  Json list = Json::array();
  std::map<int, std::string> by_id;
  for (const auto& [name, id] : number_categories(used)) {
    if (used.contains(name)) by_id.emplace(id, name);
  }
  for (const auto& [id, name] : by_id) list.push_back({{"id", id}, {"name", name}});
  return list;
}

}  // namespace thermal
