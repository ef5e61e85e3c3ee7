#include "io/label_files/coco.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/json/entry.h"
#include "io/label_files/picture_names.h"

namespace thermal {
namespace {

constexpr const char* kFractionsRule = "px; all boxes of the file are fractions of their pictures";

/// A label with its references, which may be defined later in the file.
struct UnresolvedLabel {
  Label label;
  LabelId image_id;
  LabelId category_id;
  bool has_box = true;
  std::size_t place = 0;  ///< in the file
};

/// "a/b" of "a/b/c.png" and "./a//b/c.png"; empty without a folder.
std::string folder_of(const std::string& file) {
  return Path(file).lexically_normal().parent_path().string();
}

/// "a_b" of "a/b".
std::string in_one_word(std::string folder) {
  std::ranges::replace(folder, '/', '_');
  return folder;
}

/// Category 0 of COCO Camera Traps marks a picture without targets.
bool is_empty(const LabelCategory& category) {
  return category.id == LabelId(0) && lower_case(category.name) == "empty";
}

void refuse_foreign_image(const JsonEntry& entry) {
  if (entry.has("detections"))
    throw entry.fault_of("detections", "labels of COCO: this is a file of MegaDetector's results");
  for (const char* key : {"neg_category_ids", "not_exhaustive_category_ids"})
    if (entry.has(key)) throw entry.fault_of(key, "none: labels of LVIS are incomplete on purpose");
}

void refuse_foreign_label(const JsonEntry& entry) {
  if (entry.has("bbox_mode") && entry.integer("bbox_mode") != 1)
    throw entry.fault_of("bbox_mode", "1, a bbox of x, y, width and height in px, or none");
  if (entry.optional_number("score").value_or(1) != 1)
    throw entry.fault_of("score", "1 or none: labels, not the results of a detector");
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
    drop_empty_category();
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
    if (list == "annotations") take_label({json, file_, list, place}, place);
  }

  using Places = std::unordered_map<LabelId, std::size_t>;

  /// Records an id; DataError if it is repeated.
  static LabelId new_id(const JsonEntry& entry, Places& places) {
    LabelId id = entry.id("id");
    if (const auto [there, fresh] = places.emplace(id, places.size()); !fresh)
      throw entry.fault_of("id", fmt::format("an id other than that of entry {}", there->second));
    return id;
  }

  void take_category(const JsonEntry& entry) {
    LabelId id = new_id(entry, category_places_);
    set_.categories.push_back({std::move(id), entry.text("name")});
  }

  void take_video(const JsonEntry& entry) {
    new_id(entry, video_places_);
    const bool is_named = entry.has("name") || !entry.has("file_name");
    const auto rate_hz = entry.optional_number(entry.has("frame_rate_hz") ? "frame_rate_hz" : "fps");
    set_.videos.push_back({entry.text(is_named ? "name" : "file_name"), rate_hz.value_or(0)});
  }

  void take_image(const JsonEntry& entry) {
    refuse_foreign_image(entry);
    StatedImage read;
    read.image = {.id = new_id(entry, image_places_),
                  .file = file_name_in(entry),
                  .width_px = entry.has("width") ? entry.count("width") : 0,
                  .height_px = entry.has("height") ? entry.count("height") : 0,
                  .time_s = entry.optional_number("time_s")};
    if (entry.has("video_id")) read.video_id = entry.id("video_id");
    if (entry.has("seq_id")) read.sequence_id = entry.id("seq_id");
    read_frame_of(entry, read);
    images_.push_back(std::move(read));
  }

  std::string file_name_in(const JsonEntry& entry) {
    std::string name = entry.text("file_name");
    set_.from_windows |= name.find('\\') != std::string::npos;
    std::ranges::replace(name, '\\', '/');
    return name;
  }

  void take_label(const JsonEntry& entry, std::size_t place) {
    refuse_foreign_label(entry);
    UnresolvedLabel read{.label = read_label(entry),
                         .image_id = entry.id("image_id"),
                         .category_id = entry.id("category_id"),
                         .has_box = entry.has("bbox"),
                         .place = place};
    read.label.id = new_id(entry, label_places_);
    labels_.push_back(std::move(read));
  }

  static Label read_label(const JsonEntry& entry) {
    Label label;
    if (entry.has("bbox")) label.box = entry.box("bbox");
    label.crowd = entry.flag("iscrowd");
    label.ignore = entry.flag("ignore") || entry.optional_number("mot_conf") == 0.0;
    label.noisy = entry.flag("noisy");
    label.truncated = entry.flag("truncated");
    label.visibility = entry.optional_number("visibility");
    label.truncated_fraction = entry.optional_number("truncated_fraction");
    label.range_m = entry.optional_number("range_m");
    label.temperature_k = entry.optional_number("temperature_k");
    label.contrast_k = entry.optional_number("contrast_k");
    label.contrast_noise = entry.optional_number("contrast_noise");
    label.area_px = entry.optional_number("area").value_or(label.box.area_px());
    const char* const track = entry.has("track_id") ? "track_id" : "instance_id";
    if (entry.has(track)) label.track_id = entry.integer(track);
    if (entry.has("occluded")) label.occluded = entry.flag("occluded");
    return label;
  }

  /// Sorts pictures by video and frame.
  void place_images() {
    find_videos();
    order_frames(file_, images_, set_.videos);
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

  /// Pictures without a video form one per sequence, or per folder.
  void find_videos() {
    std::map<LabelId, std::size_t> sequences;
    std::map<std::string, std::size_t> folders;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      StatedImage& read = images_[i];
      if (read.video_id) {
        read.image.video = video_of(i, *read.video_id);
        continue;
      }
      const auto [video, fresh] = read.sequence_id ? place_in(sequences, *read.sequence_id)
                                                   : place_in(folders, folder_of(read.image.file));
      if (fresh) set_.videos.emplace_back();
      read.image.video = video;
    }
    for (const auto& [id, video] : sequences)
      set_.videos[video].name =
          std::holds_alternative<std::string>(id) ? std::get<std::string>(id) : id_text(id);
    name_folders(folders);
  }

  template <typename Key>
  std::pair<std::size_t, bool> place_in(std::map<Key, std::size_t>& videos, const Key& key) const {
    const auto [there, fresh] = videos.emplace(key, set_.videos.size());
    return {there->second, fresh};
  }

  /// Names the video of folder a/b a_b, unless that is ambiguous.
  void name_folders(const std::map<std::string, std::size_t>& folders) {
    std::map<std::string, int> uses;
    const auto usual_name = [this](const std::string& folder) {
      return folder.empty() ? set_.name : in_one_word(folder);
    };
    for (const auto& [folder, video] : folders) ++uses[usual_name(folder)];
    for (const auto& [folder, video] : folders) {
      const std::string name = usual_name(folder);
      set_.videos[video].name = uses[name] == 1 || folder.empty() ? name : folder;
    }
  }

  std::size_t video_of(std::size_t image, const LabelId& id) const {
    const auto found = video_places_.find(id);
    if (found != video_places_.end()) return found->second;
    throw DataError(fault(fmt::format("{}: images[{}].video_id", file_, image), id_text(id), "",
                          "the id of one of the videos"));
  }

  void place_labels() {
    std::map<std::size_t, std::size_t> empty;  // index of an annotation, by picture
    for (UnresolvedLabel& read : labels_) {
      read.label.image = location_of(image_places_, read.place, "image_id", read.image_id, "images");
      read.label.category =
          location_of(category_places_, read.place, "category_id", read.category_id, "categories");
      if (read.has_box) check_inside(read.place, read.label.box, set_.images[read.label.image]);
      if (read.has_box) continue;
      if (!is_empty(set_.categories[read.label.category]))
        throw fault_of_label(read.place, "bbox", "nothing", "one, or category 0, \"empty\"");
      empty.emplace(read.label.image, read.place);
    }
    std::erase_if(labels_, [](const UnresolvedLabel& read) { return !read.has_box; });
    for (const UnresolvedLabel& read : labels_) {
      if (const auto found = empty.find(read.label.image); found != empty.end())
        throw fault_of_label(
            read.place, "image_id", id_text(read.image_id),
            fmt::format("a picture that annotations[{}] does not call empty", found->second));
    }
    std::stable_sort(labels_.begin(), labels_.end(), [](const UnresolvedLabel& a, const UnresolvedLabel& b) {
      return a.label.image < b.label.image;
    });
    set_.labels.reserve(labels_.size());
    for (UnresolvedLabel& read : labels_) set_.labels.push_back(std::move(read.label));
    if (are_fractions(set_.labels))
      throw fault_of_label(labels_.front().place, "bbox", box_text(set_.labels.front().box), kFractionsRule);
  }

  void drop_empty_category() {
    const auto empty = std::ranges::find_if(set_.categories, is_empty);
    const auto place = static_cast<std::size_t>(empty - set_.categories.begin());
    if (empty == set_.categories.end() ||
        std::ranges::any_of(set_.labels, [place](const Label& label) { return label.category == place; }))
      return;
    set_.categories.erase(empty);
    for (Label& label : set_.labels) label.category -= label.category > place ? 1 : 0;
  }

  [[nodiscard]] DataError fault_of_label(std::size_t label, const char* key, const std::string& value,
                                         const std::string& rule) const {
    return DataError(fault(fmt::format("{}: annotations[{}].{}", file_, label, key), value, "", rule));
  }

  std::size_t location_of(const Places& places, std::size_t label, const char* key, const LabelId& id,
                          const char* list) const {
    const auto found = places.find(id);
    if (found != places.end()) return found->second;
    throw fault_of_label(label, key, id_text(id), fmt::format("the id of one of the {}", list));
  }

  /// A box may extend beyond its picture, as truncated targets do in many files, but must not lie outside it.
  void check_inside(std::size_t label, const LabelBox& box, const LabelImage& image) const {
    if (image.width_px == 0 || image.height_px == 0) return;
    if (box.x_px < image.width_px && box.y_px < image.height_px && box.x_px + box.width_px >= 0 &&
        box.y_px + box.height_px >= 0)
      return;
    throw fault_of_label(
        label, "bbox", box_text(box) + " px",
        fmt::format("a box inside its picture, {} x {} px", image.width_px, image.height_px));
  }

  static std::string box_text(const LabelBox& box) {
    return fmt::format("[{}, {}, {}, {}]", box.x_px, box.y_px, box.width_px, box.height_px);
  }

  std::string file_;
  LabelSet set_;
  Places category_places_;
  Places video_places_;
  Places image_places_;  ///< in the file's order until place_images()
  Places label_places_;
  std::vector<StatedImage> images_;
  std::vector<UnresolvedLabel> labels_;
};

}  // namespace

LabelSet read_coco(const Path& file) { return CocoReader(file).read(); }

namespace {

/// Thrown to end reading.
struct ImagesBegin {};

void take(const std::string& file, const std::string& list, std::size_t place, const Json& json,
          CocoHead& head) {
  if (list == "images" || list == "annotations") throw ImagesBegin();
  const JsonEntry entry(json, file, list, place);
  if (list == "categories") head.categories.emplace_back(entry.text("name"), entry.integer("id"));
  if (list == "videos") head.videos.push_back(entry.text("name"));
}

}  // namespace

CocoHead read_coco_head(const Path& file) {
  check_is_own_file(file);
  CocoHead head;
  const std::string name = file.string();
  try {
    (void)read_json_elements(file, [&](const std::string& list, std::size_t place, const Json& json) {
      take(name, list, place, json, head);
    });
  } catch (const ImagesBegin&) {
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
  if (head.categories.empty())
    throw DataError(
        fmt::format("{}: no list \"categories\" before its images; expected a COCO file of Veldt's", name));
  return head;
}

}  // namespace thermal
