#include "io/label_files/detections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/json/entry.h"
#include "io/json/file.h"
#include "io/label_files/picture_names.h"
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

/// The picture of an entry of a results file, and by what it was named.
struct NamedPicture {
  std::size_t image = 0;
  bool by_name = false;  ///< and not by its id
  bool has_file_name = false;
  bool id_is_stem = false;  ///< image_id is the stem of file_name, as Ultralytics writes it
};

/// Finds the pictures of entries by `image_id` and `file_name`, which must agree.
class PictureFinder {
 public:
  explicit PictureFinder(const LabelSet& truth) : truth_(truth) {
    for (std::size_t i = 0; i < truth.images.size(); ++i) ids_.emplace(truth.images[i].id, i);
  }

  NamedPicture find(const JsonEntry& entry) {
    const LabelId id = entry.id("image_id");
    const auto* const name = std::get_if<std::string>(&id);
    NamedPicture found;
    found.has_file_name = entry.has("file_name");
    found.id_is_stem = found.has_file_name && is_stem(id, entry.text("file_name"));
    if (const auto known = ids_.find(id); known != ids_.end()) {
      found.image = known->second;
    } else {
      if (name == nullptr && !found.has_file_name)
        throw entry.fault_of("image_id", "the id of one of the truth's pictures");
      found.by_name = true;
      const char* const key = name != nullptr ? "image_id" : "file_name";
      found.image = named(entry, key, entry.text(key));
    }
    if (found.has_file_name && !names().is_name_of(entry.text("file_name"), found.image))
      throw entry.fault_of("image_id", fmt::format("the id of its file_name, \"{}\", and not of {}",
                                                   entry.text("file_name"), truth_.images[found.image].file));
    return found;
  }

 private:
  static bool is_stem(const LabelId& id, const std::string& file_name) {
    const std::string stem = Path(name_without_ending(file_name)).filename().string();
    if (const auto* const text = std::get_if<std::string>(&id)) return *text == stem;
    return number_in<std::int64_t>(stem) == std::get<std::int64_t>(id);
  }

  std::size_t named(const JsonEntry& entry, const char* key, const std::string& name) {
    const auto image = names().find(name, entry.location_of(key));
    if (image) return *image;
    throw entry.fault_of(key,
                         "the id or the name of one of the truth's pictures" + names().suggestion_for(name));
  }

  /// Built at the first use: most files have ids.
  const PictureNames& names() {
    if (!names_) names_.emplace(truth_);
    return *names_;
  }

  const LabelSet& truth_;
  std::unordered_map<LabelId, std::size_t> ids_;
  std::optional<PictureNames> names_;
};

/// A category_id of a results file, and its two possible meanings: an id, or an index into the truth's list from 1.
struct CategoryNumber {
  LabelId number;
  std::optional<std::size_t> by_id = {};
  std::optional<std::size_t> by_place = {};
};

/// Reads a COCO results file one entry at a time. Ultralytics numbers categories from 1 in the order of its classes
/// instead of by id; its files are recognized by how they name pictures.
class ResultsReader {
 public:
  ResultsReader(const LabelSet& truth, const std::string& file)
      : truth_(truth), file_(file), pictures_(truth) {
    for (std::size_t i = 0; i < truth.categories.size(); ++i) ids_.emplace(truth.categories[i].id, i);
  }

  void take(const JsonEntry& entry) {
    if (entry.has("bbox_mode") && entry.integer("bbox_mode") != 1)
      throw entry.fault_of("bbox_mode", "1, a bbox of x, y, width and height in px, or none");
    const NamedPicture picture = pictures_.find(entry);
    may_be_places_ &= picture.by_name || picture.id_is_stem;
    must_be_places_ |= picture.by_name && picture.has_file_name;
    numbers_.push_back(category_of(entry));
    if (!may_be_places_ && !numbers_.back().by_id) throw entry.fault_of("category_id", rule_of_ids());
    detections_.push_back(
        {.image = picture.image, .category = 0, .box = entry.box("bbox"), .score = entry.number("score")});
    const std::string wrong = fault_of_place(detections_.back().box, truth_.images[picture.image]);
    if (!wrong.empty()) throw entry.fault_of("bbox", wrong);
  }

  std::vector<Detection> finish() {
    if (are_fractions(detections_))
      throw DataError(file_ + ": all boxes are fractions of their pictures; expected boxes in px");
    const Reading meant = reading();
    for (std::size_t i = 0; i < numbers_.size(); ++i) detections_[i].category = *(numbers_[i].*meant);
    return std::move(detections_);
  }

 private:
  using Reading = std::optional<std::size_t> CategoryNumber::*;

  /// The only interpretation of the file's numbers in which each is a category.
  [[nodiscard]] Reading reading() const {
    const auto first_without = [this](Reading reading) {
      const auto found = std::ranges::find_if(numbers_, [reading](const auto& n) { return !(n.*reading); });
      return static_cast<std::size_t>(found - numbers_.begin());
    };
    const std::size_t no_id = first_without(&CategoryNumber::by_id);
    const std::size_t no_place = first_without(&CategoryNumber::by_place);
    const bool are_ids = no_id == numbers_.size() && !(must_be_places_ && may_be_places_);
    const bool are_places = no_place == numbers_.size() && may_be_places_;
    if (are_ids && are_places) check_alike();
    if (are_ids) return &CategoryNumber::by_id;
    if (are_places) return &CategoryNumber::by_place;
    throw may_be_places_ ? fault_of(no_place, rule_of_places()) : fault_of(no_id, rule_of_ids());
  }

  void check_alike() const {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      const CategoryNumber& number = numbers_[i];
      if (number.by_id == number.by_place) continue;
      throw fault_of(
          i, fmt::format("a number of one meaning: it is the id of {} and, as Ultralytics counts, {}",
                         truth_.categories[*number.by_id].name, truth_.categories[*number.by_place].name));
    }
  }

  [[nodiscard]] CategoryNumber category_of(const JsonEntry& entry) const {
    CategoryNumber category{.number = entry.id("category_id")};
    if (const auto found = ids_.find(category.number); found != ids_.end()) category.by_id = found->second;
    const auto* const place = std::get_if<std::int64_t>(&category.number);
    if (place != nullptr && *place >= 1 && std::cmp_less_equal(*place, truth_.categories.size()))
      category.by_place = static_cast<std::size_t>(*place - 1);
    return category;
  }

  [[nodiscard]] DataError fault_of(std::size_t entry, const std::string& rule) const {
    return DataError(
        fault(fmt::format("{}: [{}].category_id", file_, entry), id_text(numbers_[entry].number), "", rule));
  }

  [[nodiscard]] std::string rule_of_ids() const {
    std::vector<std::string> known;
    for (const LabelCategory& category : truth_.categories)
      known.push_back(fmt::format("{} ({})", id_text(category.id), category.name));
    const auto* const name = std::get_if<std::string>(&numbers_.back().number);
    return "one of " + list_names(known) +
           (name == nullptr ? "" : did_you_mean(*name, category_names(truth_)));
  }

  [[nodiscard]] std::string rule_of_places() const {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < truth_.categories.size(); ++i)
      known.push_back(fmt::format("{} ({})", i + 1, truth_.categories[i].name));
    return "one of " + list_names(known) + ", counted as Ultralytics does";
  }

  const LabelSet& truth_;
  const std::string& file_;
  PictureFinder pictures_;
  std::unordered_map<LabelId, std::size_t> ids_;
  bool may_be_places_ = true;    ///< all entries name pictures as Ultralytics does: indices are possible
  bool must_be_places_ = false;  ///< some entries name pictures as only Ultralytics does: ids are impossible
  std::vector<CategoryNumber> numbers_;
  std::vector<Detection> detections_;
};

std::vector<Detection> read_coco_results(const Path& file, const LabelSet& truth) {
  const std::string name = file.string();
  const std::string text = read_file(file);
  ResultsReader reader(truth, name);
  const auto is_list = [&name](bool is) {
    if (is) return;
    throw DataError(name +
                    R"(: no list of detections; expected [{"image_id", "category_id", "bbox", "score"}, …])");
  };
  const auto take = [&](const std::string& list, std::size_t place, const Json& json) {
    if (list == "images" && json.is_object() && json.contains("detections"))
      throw DataError(name +
                      ": results of MegaDetector, whose boxes are fractions of pictures; expected COCO's");
    is_list(list.empty());
    reader.take(JsonEntry(json, name, list, place));
  };
  try {
    is_list(parse_json_elements(text, name, take).is_array());
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
  return reader.finish();
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

/// The .txt files of a folder, sorted by name. DataError if it holds only other files, which are not results.
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

std::size_t picture_of(const Path& file, const PictureNames& pictures) {
  const std::string stem = file.stem().string();
  if (const auto image = pictures.find(stem, file.string())) return *image;
  throw DataError(fmt::format("{}: names no picture of the truth; expected VIDEO_PICTURE.txt{}",
                              file.string(), pictures.suggestion_for(stem)));
}

std::vector<Detection> read_yolo_results(const Path& folder, const LabelSet& truth) {
  const PictureNames pictures(truth);
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
