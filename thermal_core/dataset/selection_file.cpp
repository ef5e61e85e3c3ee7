#include "dataset/selection_file.h"

#include <algorithm>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/json/file.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

/// Schema of the file. Users may write their own: only the frames are required.
constexpr const char* kSchema = R"({
  "type": "object",
  "required": ["format", "version", "datasets"],
  "additionalProperties": false,
  "properties": {
    "format": {"type": "string", "enum": ["veldt-selection"]},
    "version": {"type": "integer", "enum": [1]},
    "seed": {"type": "integer", "minimum": 0, "maximum": 4294967295, "default": 0},
    "per_class": {"type": "object", "default": {}, "additionalProperties": {
      "type": "object",
      "required": ["at_least", "at_most", "available", "taken"],
      "additionalProperties": false,
      "properties": {
        "at_least": {"type": "integer", "minimum": 0}, "at_most": {"type": "integer", "minimum": 0},
        "available": {"type": "integer", "minimum": 0}, "taken": {"type": "integer", "minimum": 0}}}},
    "totals": {"type": "object"},
    "objective": {"type": "integer", "minimum": 0, "default": 0},
    "bound": {"type": "integer", "minimum": 0, "default": 0},
    "gap": {"type": "number", "minimum": 0, "default": 0},
    "datasets": {"type": "array", "items": {
      "type": "object",
      "required": ["path", "name", "videos"],
      "additionalProperties": false,
      "properties": {
        "path": {"type": "string"},
        "name": {"type": "string"},
        "videos": {"type": "array", "items": {
          "type": "object",
          "required": ["name", "frames"],
          "additionalProperties": false,
          "properties": {
            "name": {"type": "string"},
            "frames": {"type": "array", "items": {"type": "integer", "minimum": 0, "maximum": 2147483647}}}}}}}}
  }
})";

Json classes_json(const Selection& selection) {
  Json json = Json::object();
  for (const SelectedClass& one : selection.classes)
    json[one.name] = {{"at_least", one.at_least},
                      {"at_most", one.at_most},
                      {"available", one.available},
                      {"taken", one.taken}};
  return json;
}

Json totals_json(const Selection& selection) {
  std::size_t videos = 0;
  std::size_t frames = 0;
  std::int64_t labels = 0;
  for (const SelectedDataset& dataset : selection.datasets) {
    videos += dataset.videos.size();
    for (const SelectedVideo& video : dataset.videos) frames += video.frames.size();
  }
  for (const SelectedClass& one : selection.classes) labels += one.taken;
  return {{"videos", videos}, {"frames", frames}, {"labels", labels}};
}

/// One video per line, for readability.
std::string datasets_text(const Selection& selection) {
  std::vector<std::string> datasets;
  for (const SelectedDataset& dataset : selection.datasets) {
    std::vector<std::string> videos;
    for (const SelectedVideo& video : dataset.videos)
      videos.push_back("\n      " + Json{{"name", video.name}, {"frames", video.frames}}.dump());
    datasets.push_back(fmt::format("\n    {{\"path\": {}, \"name\": {}, \"videos\": [{}]}}",
                                   Json(dataset.path).dump(), Json(dataset.name).dump(),
                                   fmt::join(videos, ",")));
  }
  return fmt::format("[{}]", fmt::join(datasets, ","));
}

/// Paths and names may be any bytes; JSON is text.
void check_text(const std::string& text) {
  try {
    (void)Json(text).dump();
  } catch (const Json::exception&) {
    const std::string shown = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    throw DataError(fault("name", shown, "", "UTF-8"));
  }
}

SelectedVideo read_video(const Json& json) {
  return {.name = json["name"], .frames = json["frames"].get<std::vector<int>>()};
}

SelectedDataset read_dataset(const Json& json) {
  SelectedDataset dataset{.path = json["path"], .name = json["name"], .videos = {}};
  for (const Json& video : json["videos"]) dataset.videos.push_back(read_video(video));
  return dataset;
}

Selection read_document(const Json& json) {
  Selection selection;
  selection.seed = json["seed"];
  selection.objective = json["objective"];
  selection.bound = json["bound"];
  selection.gap = json["gap"];
  for (const auto& [name, one] : json["per_class"].items())
    selection.classes.push_back({.name = name,
                                 .at_least = one["at_least"],
                                 .at_most = one["at_most"],
                                 .available = one["available"],
                                 .taken = one["taken"]});
  for (const Json& dataset : json["datasets"]) selection.datasets.push_back(read_dataset(dataset));
  return selection;
}

void check_frames(const std::vector<int>& frames, const std::string& where) {
  const auto fall = std::adjacent_find(frames.begin(), frames.end(), std::greater_equal<>());
  if (fall == frames.end()) return;
  const auto place = fall - frames.begin() + 1;
  throw DataError(fault(fmt::format("{}[{}]", where, place), std::to_string(*(fall + 1)), "",
                        fmt::format("more than {}, the frame before it", *fall)));
}

void check_dataset(const SelectedDataset& dataset, const std::string& where) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < dataset.videos.size(); ++i) {
    const std::string video = fmt::format("{}.videos[{}]", where, i);
    if (!seen.insert(dataset.videos[i].name).second)
      throw DataError(fault(video + ".name", "\"" + dataset.videos[i].name + "\"", "",
                            "a name unique among the videos of the dataset"));
    check_frames(dataset.videos[i].frames, video + ".frames");
  }
}

void check(const Selection& selection) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < selection.datasets.size(); ++i) {
    const std::string where = fmt::format("datasets[{}]", i);
    if (!seen.insert(selection.datasets[i].path).second)
      throw DataError(fault(where + ".path", "\"" + selection.datasets[i].path + "\"", "",
                            "a path unique among the datasets"));
    check_dataset(selection.datasets[i], where);
  }
}

bool is_same_place(const Path& one, const Path& other) {
  std::error_code error;
  return (one / "").lexically_normal() == (other / "").lexically_normal() ||
         (std::filesystem::equivalent(one, other, error) && !error);
}

}  // namespace

void write_selection(const Path& file, const Selection& selection) {
  for (const SelectedDataset& dataset : selection.datasets) {
    check_text(dataset.path);
    check_text(dataset.name);
    for (const SelectedVideo& video : dataset.videos) check_text(video.name);
  }
  Json head = {{"format", "veldt-selection"},      {"version", 1},
               {"seed", selection.seed},           {"per_class", classes_json(selection)},
               {"totals", totals_json(selection)}, {"objective", selection.objective},
               {"bound", selection.bound},         {"gap", selection.gap}};
  std::string text = head.dump(2);
  text.resize(text.size() - 2);  // the newline and the brace at its end
  write_file_atomically(file, text + ",\n  \"datasets\": " + datasets_text(selection) + "\n}\n");
}

Selection read_selection(const Path& file) {
  try {
    Json document = read_json(file);
    const std::vector<std::string> faults = check_and_fill(document, parse_json(kSchema, "schema"));
    if (!faults.empty()) throw DataError(faults.front());
    Selection selection = read_document(document);
    check(selection);
    return selection;
  } catch (const ConfigError& error) {  // not JSON: the message names the file
    throw DataError(error.what());
  } catch (const DataError& error) {
    throw DataError(file.string() + ": " + error.what());
  }
}

const SelectedDataset& selection_for(const Selection& selection, const Path& file, const Path& path,
                                     const std::string& name) {
  std::vector<const SelectedDataset*> named;
  std::vector<std::string> known;
  for (const SelectedDataset& dataset : selection.datasets) {
    if (is_same_place(dataset.path, path)) return dataset;
    if (dataset.name == name) named.push_back(&dataset);
    known.push_back(dataset.path);
  }
  if (named.size() == 1) return *named.front();
  throw DataError(fmt::format("{}: no entry for {}; expected one of {}{}", file.string(), path.string(),
                              list_names(known), did_you_mean(path.string(), known)));
}

}  // namespace thermal
