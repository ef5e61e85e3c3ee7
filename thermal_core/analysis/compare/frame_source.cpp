#include "analysis/compare/frame_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "dataset/clip_files.h"
#include "dataset/dataset_file.h"
#include "dataset/label_source.h"
#include "io/image/pictures.h"
#include "io/json/file.h"
#include "io/label_files/coco.h"
#include "io/system/sequence.h"

namespace thermal {
namespace {

constexpr const char* kNamesRule =
    "text and the fields {altitude_m}, {look_angle_deg} and {_}, one of the first two among them, with text "
    "between fields";

bool is_field(std::string_view name) {
  constexpr std::array<std::string_view, 3> kFields = {"altitude_m", "look_angle_deg", "_"};
  return std::find(kFields.begin(), kFields.end(), name) != kFields.end();
}

}  // namespace

FrameNames::FrameNames(std::string_view pattern, const std::string& where) {
  const auto refuse = [&] { throw ConfigError(fault(where, pattern, "", kNamesRule)); };
  start_ = pattern.substr(0, pattern.find('{'));
  for (std::size_t at = start_.size(); at < pattern.size();) {
    const std::size_t close = pattern.find('}', at);
    if (close == std::string_view::npos) refuse();
    const std::size_t next = std::min(pattern.find('{', close), pattern.size());
    pieces_.push_back({.field = std::string(pattern.substr(at + 1, close - at - 1)),
                       .text = std::string(pattern.substr(close + 1, next - close - 1))});
    if (!is_field(pieces_.back().field) || (pieces_.back().text.empty() && next < pattern.size())) refuse();
    at = next;
  }
  if (std::all_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) { return piece.field == "_"; }))
    refuse();
}

std::optional<NamedPose> FrameNames::read(std::string_view name) const {
  if (!name.starts_with(start_)) return {};
  name.remove_prefix(start_.size());
  NamedPose pose;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const bool last = k + 1 == pieces_.size();
    const std::string& text = pieces_[k].text;
    if (last && !name.ends_with(text)) return {};
    const std::size_t end = last ? name.size() - text.size() : name.find(text, 1);
    if (end == std::string_view::npos || end == 0) return {};
    const auto number = number_in<double>(name.substr(0, end));
    if (pieces_[k].field != "_" && !(number && std::isfinite(*number))) return {};
    if (pieces_[k].field == "altitude_m") pose.altitude_m = number;
    if (pieces_[k].field == "look_angle_deg") pose.look_angle_deg = number;
    name.remove_prefix(end + text.size());
  }
  return pose;
}

namespace {

/// Boxes of one category by image, without crowds and ignored ones.
std::vector<std::vector<LabelBox>> boxes_of(const LabelSet& set, const std::string& category) {
  std::vector<std::vector<LabelBox>> boxes(set.images.size());
  for (const Label& label : set.labels) {
    if (label.crowd || label.ignore || !is_requested(set.categories[label.category].name, category)) continue;
    boxes[label.image].push_back(label.box);
  }
  return boxes;
}

void say_if_none(const LabelSet& set, const std::string& category, FrameSource& source) {
  for (const SourceFrame& frame : source.frames) {
    if (!frame.boxes.empty()) return;
  }
  std::vector<std::string> names;
  for (const LabelCategory& known : set.categories) names.push_back(known.name);
  source.no_boxes = fmt::format("no boxes of {} in {}; its categories: {}",
                                category.empty() ? "people" : category, source.name, list_names(names));
}

// --- a Veldt dataset

/// Heights above ground by frame, where a clip's frames.jsonl states them.
std::map<int, double> altitudes_in(const Path& file) {
  std::map<int, double> altitudes;
  check_is_no_link(file);
  for_frame_lines(file, [&altitudes](const Json& frame) {
    if (frame.contains("agl_m")) altitudes[frame.at("frame_index").get<int>()] = frame["agl_m"].get<double>();
  });
  return altitudes;
}

StoredScale scale_of(const Path& dataset) {
  const Json value = read_dataset_file(dataset).value("kelvin_per_count", Json());
  const double kelvin = value.is_number() ? value.get<double>() : 0;
  if (!(kelvin > 0))
    throw DataError(fault(Layout{dataset}.dataset_json().string() + ": kelvin_per_count", brief(value), "K",
                          "more than 0"));
  return {.kelvin_per_count = kelvin};
}

void check_has_no_scale(const FrameRequest& request) {
  const std::string& prefix = request.scale.prefix;
  const char* option = request.scale.kelvin_per_count ? "kelvin-per-count" : "unit";
  if (request.scale.kelvin_per_count || request.scale.unit)
    throw ConfigError(
        fmt::format("{}{}: {} is a Veldt dataset, which states the scale of its ir16; expected it "
                    "for a folder of pictures of your own",
                    prefix, option, request.source.string()));
}

FrameSource read_dataset_frames(const FrameRequest& request) {
  if (!request.labels.empty() || !request.names.empty())
    throw ConfigError(
        fmt::format("{} is a Veldt dataset, which has labels and heights; expected a folder of "
                    "pictures with labels or a pattern of names of your own",
                    request.source.string()));
  check_has_no_scale(request);
  LabelSet set = read_labels(request.source);
  if (request.kelvin)
    for (LabelImage& image : set.images) image.file = ir16_file(image.file);
  if (request.boxes == BoxStyle::drawn) widen_as_drawn(set);
  const auto boxes = boxes_of(set, request.category);
  FrameSource source = {.name = request.source.string(), .is_dataset = true, .frames = {}, .no_boxes = {}};
  std::map<Path, std::map<int, double>> clips;
  for (std::size_t k = 0; k < set.images.size(); ++k) {
    const LabelImage& image = set.images[k];
    SourceFrame frame = {.file = picture_of(set, image),
                         .name = image.file,
                         .video = image.video,
                         .altitude_m = {},
                         .boxes = boxes[k]};
    const Path clip = frame.file.parent_path().parent_path();
    const auto [known, fresh] = clips.try_emplace(clip);
    if (fresh) known->second = altitudes_in(clip / "frames.jsonl");
    const auto altitude = known->second.find(image.frame_index);
    if (altitude != known->second.end()) frame.altitude_m = altitude->second;
    source.frames.push_back(std::move(frame));
  }
  if (request.kelvin) source.kelvin = KelvinLevels{.stored = scale_of(request.source)};
  say_if_none(set, request.category, source);
  return source;
}

// --- a folder of pictures

Path labels_of(const FrameRequest& request) {
  if (!request.labels.empty()) return request.labels;
  const Path folder = std::filesystem::absolute(request.source / "").lexically_normal().parent_path();
  for (const Path& place : {folder, folder.parent_path()}) {
    if (std::filesystem::is_regular_file(place / "annotations.json")) return place / "annotations.json";
  }
  return {};
}

void add_altitudes(const FrameRequest& request, FrameSource& source) {
  if (request.names.empty()) return;
  const FrameNames names(request.names, request.names_option);
  for (SourceFrame& frame : source.frames) {
    const std::string name = Path(frame.name).stem().string();
    const auto pose = names.read(name);
    if (!pose)
      throw DataError(
          fault(frame.file.string() + ": name", name, "", request.names_option + " " + request.names));
    frame.altitude_m = pose->altitude_m;
  }
}

/// The picture of a frame among several with its name: the one in its folder.
std::size_t picture_of_frame(const SourceFrame& frame, const std::vector<std::size_t>& named,
                             const LabelSet& set, const Path& labels) {
  if (named.size() == 1) return named.front();
  const std::string file = std::filesystem::absolute(frame.file).lexically_normal().string();
  std::vector<std::string> names;
  std::vector<std::size_t> here;
  for (const std::size_t k : named) {
    names.push_back(set.images[k].file);
    if (file.ends_with("/" + Path(names.back()).lexically_normal().string())) here.push_back(k);
  }
  if (here.size() == 1) return here.front();
  throw DataError(fmt::format("{}: {} may be any of {}; expected one picture of this name, or one in {}",
                              labels.string(), frame.name, list_names(names),
                              frame.file.parent_path().string()));
}

void add_boxes(const FrameRequest& request, FrameSource& source) {
  const Path file = labels_of(request);
  if (file.empty()) {
    source.no_boxes = fmt::format("no labels for {}", source.name);
    return;
  }
  const LabelSet set = read_coco(file);
  const auto boxes = boxes_of(set, request.category);
  std::unordered_map<std::string, std::vector<std::size_t>> images;
  for (std::size_t k = 0; k < set.images.size(); ++k)
    images[Path(set.images[k].file).filename().string()].push_back(k);
  std::size_t named = 0;
  for (SourceFrame& frame : source.frames) {
    const auto image = images.find(frame.name);
    if (image == images.end()) continue;
    frame.boxes = boxes[picture_of_frame(frame, image->second, set, file)];
    ++named;
  }
  if (named == 0)
    throw DataError(
        fmt::format("{}: names none of the {} pictures in {}; expected their names in images[].file_name",
                    file.string(), source.frames.size(), source.name));
  say_if_none(set, request.category, source);
}

FrameSource read_folder_frames(const FrameRequest& request) {
  if (request.boxes == BoxStyle::drawn)
    throw ConfigError(
        fmt::format("{} is a folder, whose labels have the boxes as they are; expected a Veldt "
                    "dataset to draw boxes for",
                    request.source.string()));
  FrameSource source = {.name = request.source.string(), .is_dataset = false, .frames = {}, .no_boxes = {}};
  for (const std::string& name : files_in(request.source)) {
    if (!is_grey_picture(name)) continue;
    source.frames.push_back(
        {.file = request.source / name, .name = name, .video = 0, .altitude_m = {}, .boxes = {}});
  }
  if (source.frames.empty())
    throw DataError(fault(source.name, "0 pictures", "",
                          "a Veldt dataset, or a folder of .png, .jpg, .jpeg, .tif or .tiff"));
  if (request.kelvin) source.kelvin = KelvinLevels{.stored = request.scale};
  add_altitudes(request, source);
  add_boxes(request, source);
  return source;
}

}  // namespace

bool is_requested(const std::string& category, const std::string& requested) {
  const std::string name = lower_case(category);
  return requested.empty() ? kind_of(name) == Kind::human : name == lower_case(requested);
}

FrameSource read_frame_source(const FrameRequest& request) {
  if (Layout{request.source}.is_begun()) return read_dataset_frames(request);
  if (!std::filesystem::exists(request.source))
    throw IoError(fmt::format("{} does not exist", request.source.string()));
  return read_folder_frames(request);
}

}  // namespace thermal
