#include "dataset/exports/yolo.h"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

#include "io/json/entry.h"

namespace thermal {
namespace {

/// Clips a box to its picture; sides are 0 or less if it is outside.
LabelBox cut(const LabelBox& box, const LabelImage& image) {
  const double left_px = std::max(box.x_px, 0.0);
  const double top_px = std::max(box.y_px, 0.0);
  const double right_px = std::min(box.x_px + box.width_px, static_cast<double>(image.width_px));
  const double bottom_px = std::min(box.y_px + box.height_px, static_cast<double>(image.height_px));
  return {.x_px = left_px, .y_px = top_px, .width_px = right_px - left_px, .height_px = bottom_px - top_px};
}

std::string line_of(const Label& label, const LabelImage& image) {
  const LabelBox box = cut(label.box, image);
  return fmt::format("{} {:.8f} {:.8f} {:.8f} {:.8f}\n", label.category,
                     (box.x_px + box.width_px / 2) / image.width_px,
                     (box.y_px + box.height_px / 2) / image.height_px, box.width_px / image.width_px,
                     box.height_px / image.height_px);
}

std::string line_of(const Label& label, const LabelImage& image, const Outline& outline) {
  std::string line = std::to_string(label.category);
  for (const OutlinePoint& point : outline)
    line += fmt::format(" {:.7f} {:.7f}", point.x_px / image.width_px, point.y_px / image.height_px);
  return line + "\n";
}

/// JSON strings are also valid YAML.
std::string quoted(const std::string& text) { return Json(text).dump(); }

bool has_split(const ExportInput& input, const std::string& name) {
  return std::ranges::find(input.splits, name) != input.splits.end();
}

std::string data_yaml(const ExportInput& input, const std::string& folder) {
  const std::string train = has_split(input, "train") ? "train" : input.splits.front();
  std::string text =
      fmt::format("# {}\npath: {}  # if you move the folder, change or delete this\ntrain: images/{}\n",
                  quoted(input.set.name), quoted(folder), train);
  text +=
      has_split(input, "val")
          ? "val: images/val\n"
          : fmt::format("val: images/{}  # there is no split val: these pictures are trained on\n", train);
  if (has_split(input, "test")) text += "test: images/test\n";
  text += "names:\n";
  for (std::size_t i = 0; i < input.set.categories.size(); ++i)
    text += fmt::format("  {}: {}\n", i, quoted(input.set.categories[i].name));
  return text;
}

}  // namespace

std::string why_not_in_yolo(const LabelSet& set, const Label& label) {
  if (label.crowd) return "of crowds, which YOLO cannot mark";
  if (label.ignore) return "marked as ignored, which YOLO cannot mark";
  const LabelBox box = cut(label.box, set.images[label.image]);
  return box.width_px > 0 && box.height_px > 0 ? "" : "outside their picture";
}

Outlines yolo_outlines(const ExportInput& input, const std::string& text, const std::string& name,
                       SegmentMaker& segments) {
  std::unordered_set<LabelId> wanted;
  for (const Label& label : input.set.labels)
    if (why_not_in_yolo(input.set, label).empty()) wanted.insert(label.id);
  Outlines outlines;
  (void)parse_json_elements(text, name, [&](const std::string& list, std::size_t, const Json& element) {
    if (list != "annotations") return;
    const LabelId id = label_id_in(element.at("id"));
    if (wanted.contains(id)) outlines.emplace(id, segments.outline_of(element));
  });
  return outlines;
}

ExportPlan plan_yolo(const ExportInput& input, const std::string& folder, const Outlines* outlines) {
  const LabelSet& set = input.set;
  const std::vector<std::size_t> first = first_labels(set);
  ExportPlan plan;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    const LabelImage& image = set.images[i];
    const std::string place = input.splits[input.of_video[image.video]] + "/" + flat_name(set, image);
    plan.pictures.push_back({.image = i, .to = "images/" + place + ending_of(image.file)});
    std::string lines;
    for (std::size_t k = first[i]; k < first[i + 1]; ++k)
      if (const Label& label = set.labels[k]; why_not_in_yolo(set, label).empty())
        lines += outlines == nullptr ? line_of(label, image) : line_of(label, image, outlines->at(label.id));
    plan.texts.push_back({.to = "labels/" + place + ".txt", .content = std::move(lines), .of = image.file});
  }
  plan.texts.push_back({.to = "data.yaml", .content = data_yaml(input, folder)});
  return plan;
}

}  // namespace thermal
