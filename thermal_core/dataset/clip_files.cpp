#include "dataset/clip_files.h"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/clip/record.h"
#include "io/json/entry.h"

namespace thermal {

void for_frame_lines(const Path& file, const std::function<void(const Json& frame)>& take) {
  std::istringstream lines(read_file(file));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      take(Json::parse(line));
    } catch (const Json::exception& error) {
      throw DataError(fmt::format("{}:{}: not a frame of a clip: {}", file.string(), number, error.what()));
    }
  }
}

namespace {

constexpr std::uint64_t kMostMaskSidePx = 1'000'000'000;

bool is_pose(const Json& pose) {
  if (!pose.is_array() || pose.size() != 16) return false;
  return std::ranges::all_of(pose, [](const Json& number) { return number.is_number(); });
}

bool is_segmentation(const Json& mask) {
  if (!mask.is_object() || !mask.contains("size") || !mask.contains("counts")) return false;
  const Json& size = mask["size"];
  return mask["counts"].is_string() && size.is_array() && size.size() == 2 && size[0].is_number_unsigned() &&
         size[1].is_number_unsigned() && size[0] <= kMostMaskSidePx && size[1] <= kMostMaskSidePx;
}

/// Reads the lists of labels.json, whose references are resolved at the end.
class LabelsReader {
 public:
  explicit LabelsReader(const Path& file) : file_(file.string()) {}

  void take(const std::string& list, std::size_t index, const Json& json) {
    const JsonEntry entry(json, file_, list, index);
    if (list == "categories") categories_.insert_or_assign(entry.integer("id"), entry.text("name"));
    if (list == "images") frames_.insert_or_assign(entry.integer("id"), entry.count("frame_index"));
    if (list == "annotations") add_annotation(entry, json);
  }

  void check_lists(const Json& rest) const {
    for (const char* list : {"categories", "images", "annotations"}) {
      if (!rest.is_object() || !rest.contains(list) || !rest[list].is_array())
        throw DataError(fmt::format("{}: no list \"{}\"; expected the labels of a clip", file_, list));
    }
  }

  template <typename Take>
  void hand_over(const Take& take) const {
    for (std::size_t index = 0; index < annotations_.size(); ++index) {
      const Annotation& one = annotations_[index];
      take(find(frames_, one.image_id, "image_id", index),
           find(categories_, one.category_id, "category_id", index), one.text);
    }
  }

 private:
  struct Annotation {
    std::int64_t image_id = 0;
    std::int64_t category_id = 0;
    std::string text;
  };

  void add_annotation(const JsonEntry& entry, const Json& json) {
    (void)entry.integer("track_id");
    (void)entry.box("bbox");
    (void)entry.number("area");
    if (!entry.has("ignore")) throw entry.fault_of("ignore", "false or true");
    (void)entry.flag("ignore");
    if (!entry.has("segmentation") || !is_segmentation(json["segmentation"]))
      throw entry.fault_of("segmentation", "an object with size, [height, width], and counts, a text");
    annotations_.push_back({.image_id = entry.integer("image_id"),
                            .category_id = entry.integer("category_id"),
                            .text = json.dump()});
  }

  template <typename Value>
  const Value& find(const std::unordered_map<std::int64_t, Value>& values, std::int64_t id, const char* key,
                    std::size_t index) const {
    if (const auto found = values.find(id); found != values.end()) return found->second;
    throw DataError(fault(fmt::format("{}: annotations[{}].{}", file_, index, key), std::to_string(id), "",
                          "the id of an entry of the file"));
  }

  std::string file_;
  std::unordered_map<std::int64_t, std::string> categories_;
  std::unordered_map<std::int64_t, int> frames_;
  std::vector<Annotation> annotations_;
};

}  // namespace

void for_clip_frames(const Path& folder, const std::function<void(int, const Json&)>& take) {
  check_has_no_links(folder);
  const Path file = folder / "frames.jsonl";
  check_is_file(file);
  const std::string name = file.string();
  const std::string list = "line";
  std::size_t index = 0;
  int last = -1;
  for_frame_lines(file, [&](const Json& values) {
    const JsonEntry entry(values, name, list, ++index);
    const int frame_index = entry.count("frame_index");
    if (frame_index <= last) throw entry.fault_of("frame_index", fmt::format("above {}", last));
    last = frame_index;
    (void)entry.number("time_s");
    (void)entry.flag("ffc");
    if (entry.has("camera_to_world") && !is_pose(values["camera_to_world"]))
      throw entry.fault_of("camera_to_world", "16 numbers");
    take(frame_index, values);
  });
}

void for_clip_labels(const Path& folder,
                     const std::function<void(int, const std::string&, const std::string&)>& take) {
  const Path file = folder / "labels.json";
  check_is_own_file(file);
  LabelsReader reader(file);
  try {
    reader.check_lists(read_json_elements(file, [&](const std::string& list, std::size_t index,
                                                    const Json& json) { reader.take(list, index, json); }));
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
  reader.hand_over(take);
}

}  // namespace thermal
