#include "io/label_files/coco.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "io/json/entry.h"

namespace thermal {
namespace {

/// A label with its references, which may be defined later in the file.
struct UnresolvedLabel {
  Label label;
  std::int64_t image_id = 0;
  std::int64_t category_id = 0;
};

struct UnresolvedImage {
  LabelImage image;
  std::optional<std::int64_t> video_id;
};

/// "a/b/c.png" is in "a_b".
std::string folder_name(const std::string& file) {
  std::string folder = file.substr(0, std::min(file.find_last_of('/') + 1, file.size()));
  if (folder.ends_with('/')) folder.pop_back();
  std::replace(folder.begin(), folder.end(), '/', '_');
  return folder;
}

/// Reads the lists one entry at a time, and links them at the end.
class CocoReader {
 public:
  explicit CocoReader(const Path& file) : file_(file.string()) {
    set_.name = file.stem().string();
    set_.root = file.parent_path().string();
  }

  LabelSet read() {
    const std::string text = read_file(file_);
    std::vector<std::string> lists;
    try {
      const Json rest = parse_json_elements(
          text, file_,
          [this](const std::string& list, std::size_t place, const Json& json) { take(list, place, json); });
      check_lists(rest);
    } catch (const ConfigError& error) {
      throw DataError(error.what());
    }
    place_images();
    place_labels();
    return std::move(set_);
  }

 private:
  void check_lists(const Json& rest) const {
    for (const char* list : {"images", "categories", "annotations"}) {
      if (rest.is_object() && rest.contains(list) && rest[list].is_array()) continue;
      throw DataError(fmt::format(
          "{}: no list \"{}\"; expected a COCO file with images, categories and annotations", file_, list));
    }
  }

  void take(const std::string& list, std::size_t place, const Json& json) {
    if (list == "categories") take_category({json, file_, list, place});
    if (list == "videos") take_video({json, file_, list, place});
    if (list == "images") take_image({json, file_, list, place});
    if (list == "annotations") take_label({json, file_, list, place});
  }

  using Places = std::unordered_map<std::int64_t, std::size_t>;

  /// Records an id, which must be new.
  static std::int64_t new_id(const JsonEntry& entry, Places& places) {
    const std::int64_t id = entry.integer("id");
    if (const auto [there, fresh] = places.emplace(id, places.size()); !fresh)
      throw entry.fault_of("id", fmt::format("an id other than that of entry {}", there->second));
    return id;
  }

  void take_category(const JsonEntry& entry) {
    const std::int64_t id = new_id(entry, category_places_);
    set_.categories.push_back({static_cast<int>(id), entry.text("name")});
  }

  void take_video(const JsonEntry& entry) {
    new_id(entry, video_places_);
    set_.videos.push_back({entry.text("name"), entry.optional_number("frame_rate_hz").value_or(0)});
  }

  void take_image(const JsonEntry& entry) {
    UnresolvedImage read;
    read.image = {.id = new_id(entry, image_places_),
                  .file = entry.text("file_name"),
                  .width_px = entry.has("width") ? entry.count("width") : 0,
                  .height_px = entry.has("height") ? entry.count("height") : 0,
                  .frame_index = entry.has("frame_index") ? entry.count("frame_index")
                                                          : static_cast<int>(images_.size()),
                  .time_s = entry.optional_number("time_s")};
    if (entry.has("video_id")) read.video_id = entry.integer("video_id");
    images_.push_back(std::move(read));
  }

  void take_label(const JsonEntry& entry) {
    UnresolvedLabel read{.label = read_label(entry),
                         .image_id = entry.integer("image_id"),
                         .category_id = entry.integer("category_id")};
    read.label.id = new_id(entry, label_places_);
    labels_.push_back(read);
  }

  static Label read_label(const JsonEntry& entry) {
    Label label;
    label.box = entry.box("bbox");
    label.crowd = entry.flag("iscrowd");
    label.ignore = entry.flag("ignore");
    label.noisy = entry.flag("noisy");
    label.truncated = entry.flag("truncated");
    label.visibility = entry.optional_number("visibility");
    label.truncated_fraction = entry.optional_number("truncated_fraction");
    label.range_m = entry.optional_number("range_m");
    label.temperature_k = entry.optional_number("temperature_k");
    label.contrast_k = entry.optional_number("contrast_k");
    label.contrast_noise = entry.optional_number("contrast_noise");
    label.area_px = entry.optional_number("area").value_or(label.box.area_px());
    if (entry.has("track_id")) label.track_id = entry.integer("track_id");
    if (entry.has("occluded")) label.occluded = entry.flag("occluded");
    return label;
  }

  /// Sorts pictures by video and frame; pictures without a video form a video per folder.
  void place_images() {
    std::map<std::string, std::size_t> folders;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      UnresolvedImage& read = images_[i];
      if (read.video_id) {
        read.image.video = video_of(i, *read.video_id);
        continue;
      }
      const auto [folder, fresh] = folders.emplace(folder_name(read.image.file), set_.videos.size());
      if (fresh) set_.videos.push_back({folder->first.empty() ? set_.name : folder->first, 0});
      read.image.video = folder->second;
    }
    std::vector<std::size_t> order(images_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      const LabelImage& left = images_[a].image;
      const LabelImage& right = images_[b].image;
      return std::pair(left.video, left.frame_index) < std::pair(right.video, right.frame_index);
    });
    for (const std::size_t i : order) {
      image_places_[images_[i].image.id] = set_.images.size();
      set_.images.push_back(std::move(images_[i].image));
    }
  }

  std::size_t video_of(std::size_t image, std::int64_t id) const {
    const auto found = video_places_.find(id);
    if (found != video_places_.end()) return found->second;
    throw DataError(fault(fmt::format("{}: images[{}].video_id", file_, image), std::to_string(id), "",
                          "the id of one of the videos"));
  }

  void place_labels() {
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      UnresolvedLabel& read = labels_[i];
      read.label.image = place_of(image_places_, i, "image_id", read.image_id, "images");
      read.label.category = place_of(category_places_, i, "category_id", read.category_id, "categories");
      check_inside(i, read.label.box, set_.images[read.label.image]);
    }
    std::stable_sort(labels_.begin(), labels_.end(), [](const UnresolvedLabel& a, const UnresolvedLabel& b) {
      return a.label.image < b.label.image;
    });
    set_.labels.reserve(labels_.size());
    for (UnresolvedLabel& read : labels_) set_.labels.push_back(read.label);
  }

  std::size_t place_of(const Places& places, std::size_t label, const char* key, std::int64_t id,
                       const char* list) const {
    const auto found = places.find(id);
    if (found != places.end()) return found->second;
    throw DataError(fault(fmt::format("{}: annotations[{}].{}", file_, label, key), std::to_string(id), "",
                          fmt::format("the id of one of the {}", list)));
  }

  /// A box may extend beyond its picture, as truncated targets do in many files, but must not lie outside it.
  void check_inside(std::size_t label, const LabelBox& box, const LabelImage& image) const {
    if (image.width_px == 0 || image.height_px == 0) return;
    if (box.x_px < image.width_px && box.y_px < image.height_px && box.x_px + box.width_px >= 0 &&
        box.y_px + box.height_px >= 0)
      return;
    throw DataError(
        fault(fmt::format("{}: annotations[{}].bbox", file_, label),
              fmt::format("[{}, {}, {}, {}]", box.x_px, box.y_px, box.width_px, box.height_px), "px",
              fmt::format("a box inside its picture, {} x {} px", image.width_px, image.height_px)));
  }

  std::string file_;
  LabelSet set_;
  Places category_places_;
  Places video_places_;
  Places image_places_;  ///< in the file's order until place_images()
  Places label_places_;
  std::vector<UnresolvedImage> images_;
  std::vector<UnresolvedLabel> labels_;
};

}  // namespace

LabelSet read_coco(const Path& file) { return CocoReader(file).read(); }

}  // namespace thermal
