#include "labels/label_set.h"

#include <string_view>
#include <utility>

namespace thermal {
namespace {

struct BoxSum {
  double area_px = 0;
  int boxes = 0;
};

}  // namespace

std::string id_text(const LabelId& id) {
  const auto* const number = std::get_if<std::int64_t>(&id);
  return number != nullptr ? std::to_string(*number) : "\"" + std::get<std::string>(id) + "\"";
}

std::string size_class_name(SizeClass size) noexcept {
  if (size == SizeClass::small) return "small";
  return size == SizeClass::large ? "large" : "medium";
}

SizeClass size_class_of(double mean_box_area_px) noexcept {
  constexpr double kSmallBelow = 200;
  constexpr double kLargeAbove = 2000;
  if (mean_box_area_px < kSmallBelow) return SizeClass::small;
  return mean_box_area_px > kLargeAbove ? SizeClass::large : SizeClass::medium;
}

void assign_size_classes(LabelSet& set) {
  using Track = std::pair<std::size_t, std::int64_t>;  // video, track
  std::map<Track, BoxSum> sums;
  const auto track_of = [&set](const Label& label) {
    return Track{set.images[label.image].video, label.track_id.value_or(0)};
  };
  for (const Label& label : set.labels) {
    if (!label.track_id) continue;
    BoxSum& sum = sums[track_of(label)];
    sum.area_px += label.box.area_px();
    ++sum.boxes;
  }
  for (Label& label : set.labels) {
    const BoxSum sum = label.track_id ? sums.at(track_of(label)) : BoxSum{label.box.area_px(), 1};
    label.size = size_class_of(sum.area_px / sum.boxes);
  }
}

std::string flat_name(const LabelSet& set, const LabelImage& image) {
  const std::string file = image.file.substr(image.file.find_last_of('/') + 1);  // npos + 1 is 0
  std::string name = set.videos[image.video].name + "_" + file.substr(0, file.find_last_of('.'));
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == '\\'; }, '_');
  return name;
}

Kind kind_of(const std::string& category) noexcept {
  if (category == "human" || category == "person" || category == "poacher") return Kind::human;
  constexpr std::array<std::string_view, 7> kRidden = {"bicycle",    "bus",   "car", "motorbike",
                                                       "motorcycle", "truck", "van"};
  const bool drives = category.ends_with("vehicle") || std::ranges::find(kRidden, category) != kRidden.end();
  return drives ? Kind::vehicle : Kind::animal;
}

namespace {

/// Never reorder: the position is the id.
constexpr std::array<std::string_view, 18> kKnown = {
    "human",     "elephant", "rhinoceros", "hippopotamus", "zebra",   "lion",
    "crocodile", "giraffe",  "impala",     "vehicle",      "cattle",  "goat",
    "dog",       "baboon",   "warthog",    "ostrich",      "buffalo", "wildebeest"};

}  // namespace

std::map<std::string, int> number_categories(const std::set<std::string>& used) {
  std::map<std::string, int> ids;
  int id = 0;
  for (const std::string_view name : kKnown) ids.emplace(name, ++id);
  for (const std::string& name : used) {
    if (!ids.contains(name)) ids.emplace(name, ++id);
  }
  return ids;
}

}  // namespace thermal
