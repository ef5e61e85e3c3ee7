#include "io/label_files/detections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/json/entry.h"
#include "io/json/file.h"
#include "io/system/text_file.h"

namespace thermal {
namespace {

std::vector<std::string> category_names(const LabelSet& truth) {
  std::vector<std::string> names;
  for (const LabelCategory& category : truth.categories) names.push_back(category.name);
  return names;
}

/// Checks a box's position in its picture; returns the fault, or empty. Detectors may extend boxes beyond the
/// picture, or clip those outside to a line of the border: a box that touches the picture counts as inside.
std::string fault_of_place(const LabelBox& box, const LabelImage& image) {
  const auto reaches = [](double end_px) { return std::isfinite(end_px) && end_px >= 0; };
  const bool far = !reaches(box.x_px + box.width_px) || !reaches(box.y_px + box.height_px);
  const bool beyond_right = image.width_px > 0 && box.x_px > image.width_px;
  const bool beyond_bottom = image.height_px > 0 && box.y_px > image.height_px;
  if (!far && !beyond_right && !beyond_bottom) return {};
  if (image.width_px == 0 || image.height_px == 0)
    return "a box that is not to the left of its picture or above it";
  return fmt::format("a box that touches its picture, {} x {} px", image.width_px, image.height_px);
}

/// Indices of pictures and categories by their ids.
class Ids {
 public:
  explicit Ids(const LabelSet& truth) : truth_(truth) {
    for (std::size_t i = 0; i < truth.images.size(); ++i) images_.emplace(truth.images[i].id, i);
    for (std::size_t i = 0; i < truth.categories.size(); ++i) categories_.emplace(truth.categories[i].id, i);
  }

  [[nodiscard]] std::size_t image(const JsonEntry& entry) const {
    const auto found = images_.find(entry.integer("image_id"));
    if (found == images_.end()) throw entry.fault_of("image_id", "the id of one of the truth's pictures");
    return found->second;
  }

  [[nodiscard]] std::size_t category(const JsonEntry& entry, const Json& json) const {
    if (json.contains("category_id") && json["category_id"].is_string())
      throw entry.fault_of("category_id", rule() + did_you_mean(json["category_id"].get<std::string>(),
                                                                category_names(truth_)));
    const auto found = categories_.find(entry.integer("category_id"));
    if (found == categories_.end()) throw entry.fault_of("category_id", rule());
    return found->second;
  }

 private:
  [[nodiscard]] std::string rule() const {
    std::vector<std::string> known;
    for (const LabelCategory& category : truth_.categories)
      known.push_back(fmt::format("{} ({})", category.id, category.name));
    return "one of " + list_names(known);
  }

  const LabelSet& truth_;
  std::unordered_map<std::int64_t, std::size_t> images_;
  std::unordered_map<std::int64_t, std::size_t> categories_;
};

Detection detection_of(const JsonEntry& entry, const Json& json, const LabelSet& truth, const Ids& ids) {
  const Detection detection{.image = ids.image(entry),
                            .category = ids.category(entry, json),
                            .box = entry.box("bbox"),
                            .score = entry.number("score")};
  const std::string wrong = fault_of_place(detection.box, truth.images[detection.image]);
  if (!wrong.empty()) throw entry.fault_of("bbox", wrong);
  return detection;
}

std::vector<Detection> read_coco_results(const Path& file, const LabelSet& truth) {
  const std::string name = file.string();
  const std::string text = read_file(file);
  const Ids ids(truth);
  std::vector<Detection> detections;
  const auto is_list = [&name](bool is) {
    if (is) return;
    throw DataError(name +
                    R"(: no list of detections; expected [{"image_id", "category_id", "bbox", "score"}, …])");
  };
  const auto take = [&](const std::string& list, std::size_t place, const Json& json) {
    is_list(list.empty());
    detections.push_back(detection_of(JsonEntry(json, name, list, place), json, truth, ids));
  };
  try {
    is_list(parse_json_elements(text, name, take).is_array());
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
  return detections;
}

/// A line of YOLO results and its position, "FILE:LINE".
struct YoloLine {
  std::string_view text;
  std::string where;
};

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(kBlanks); begin != std::string_view::npos;
       begin = text.find_first_not_of(kBlanks, begin)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

double number_of(std::string_view word, const std::string& where, const char* name) {
  const std::optional<double> number = number_in<double>(word);
  if (number && std::isfinite(*number)) return *number;
  throw DataError(fault(fmt::format("{}: {}", where, name), word, "", "a finite number"));
}

std::size_t class_of(std::string_view word, const std::string& where, const LabelSet& truth) {
  const std::optional<std::size_t> place = number_in<std::size_t>(word);
  if (place && *place < truth.categories.size()) return *place;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < truth.categories.size(); ++i)
    known.push_back(fmt::format("{} ({})", i, truth.categories[i].name));
  throw DataError(fault(where + ": class", word, "", "one of " + list_names(known)));
}

Detection detection_of(const YoloLine& line, const LabelSet& truth, std::size_t image) {
  const std::vector<std::string_view> words = words_of(line.text);
  if (words.size() != 6)
    throw DataError(fault(line.where, fmt::format("{} words", words.size()), "", "class cx cy w h score"));
  const std::array names = {"cx", "cy", "w", "h", "score"};
  std::array<double, 5> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number_of(words[i + 1], line.where, names[i]);
  const auto [cx, cy, width, height, score] = numbers;
  if (width < 0) throw DataError(fault(line.where + ": w", words[3], "", "at least 0"));
  if (height < 0) throw DataError(fault(line.where + ": h", words[4], "", "at least 0"));
  const LabelImage& picture = truth.images[image];
  const LabelBox box{(cx - width / 2) * picture.width_px, (cy - height / 2) * picture.height_px,
                     width * picture.width_px, height * picture.height_px};
  const std::string wrong = fault_of_place(box, picture);
  if (!wrong.empty())
    throw DataError(fault(line.where + ": box",
                          fmt::format("[{}, {}, {}, {}]", words[1], words[2], words[3], words[4]), "",
                          wrong));
  return {image, class_of(words[0], line.where, truth), box, score};
}

void read_yolo_file(const Path& file, const LabelSet& truth, std::size_t image,
                    std::vector<Detection>& detections) {
  const std::string text = read_text_file(file);
  int line = 0;
  for (const std::string_view words : split(text, '\n')) {
    ++line;
    if (words.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    detections.push_back(
        detection_of(YoloLine{words, fmt::format("{}:{}", file.string(), line)}, truth, image));
  }
}

/// The .txt files of a folder by name. DataError if it holds only other files, which are not results.
std::vector<Path> text_files(const Path& folder) {
  std::vector<Path> files;
  bool others = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".txt") {
      files.push_back(entry.path());
    } else {
      others = true;
    }
  }
  if (files.empty() && others)
    throw DataError(folder.string() + ": no .txt files; expected YOLO results, one file per picture");
  std::sort(files.begin(), files.end());
  return files;
}

/// Pictures by the names that result files may use: flat_name(), and a picture's own name if it is unique.
std::map<std::string, std::size_t> pictures_by_name(const LabelSet& truth) {
  std::map<std::string, std::size_t> places;
  std::set<std::string> shared;
  for (std::size_t i = 0; i < truth.images.size(); ++i) {
    const std::string own = Path(truth.images[i].file).stem().string();
    if (!places.emplace(own, i).second) shared.insert(own);
  }
  for (const std::string& name : shared) places.erase(name);
  for (std::size_t i = 0; i < truth.images.size(); ++i) places[flat_name(truth, truth.images[i])] = i;
  return places;
}

std::size_t picture_of(const Path& file, const std::map<std::string, std::size_t>& pictures) {
  const std::string stem = file.stem().string();
  const auto found = pictures.find(stem);
  if (found != pictures.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, place] : pictures) names.push_back(name);
  throw DataError(fmt::format("{}: names no picture of the truth; expected VIDEO_PICTURE.txt{}",
                              file.string(), did_you_mean(stem, names)));
}

std::vector<Detection> read_yolo_results(const Path& folder, const LabelSet& truth) {
  const std::map<std::string, std::size_t> pictures = pictures_by_name(truth);
  std::vector<Detection> detections;
  for (const Path& file : text_files(folder)) {
    const std::size_t image = picture_of(file, pictures);
    const LabelImage& picture = truth.images[image];
    if (picture.width_px == 0 || picture.height_px == 0)
      throw DataError(fmt::format(
          "{}: the truth lacks the size of {}; expected it, because YOLO boxes are relative to it",
          file.string(), picture.file));
    read_yolo_file(file, truth, image, detections);
  }
  return detections;
}

}  // namespace

std::vector<Detection> read_detections(const Path& source, const LabelSet& truth) {
  return std::filesystem::is_directory(source) ? read_yolo_results(source, truth)
                                               : read_coco_results(source, truth);
}

}  // namespace thermal
