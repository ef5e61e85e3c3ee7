#include "dataset/dataset_file.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "io/json/entry.h"

namespace thermal {

std::string frame_name(int frame) { return fmt::format("{:06}.png", frame); }

std::string passes_name(int frame) { return fmt::format("{:06}.exr", frame); }

std::string ir16_file(const std::string& ir8_file) {
  const Path path(ir8_file);
  return (path.parent_path().parent_path() / "ir16" / path.filename()).string();
}

namespace {

/// Reads a file that may be damaged.
Json read_as_data(const Path& file) {
  try {
    return read_json(file);
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  }
}

/// A value that commands read without a check of their own: its key, and the rule for it.
struct KnownValue {
  const char* place = "";
  bool (Json::*is_right)() const noexcept = nullptr;
  const char* rule = "";
  bool may_lack = false;
};
constexpr std::array<KnownValue, 10> kKnown = {
    {{.place = "/veldt_version", .is_right = &Json::is_string, .rule = "text"},
     {.place = "/config", .is_right = &Json::is_object, .rule = "an object"},
     {.place = "/config/name", .is_right = &Json::is_string, .rule = "text"},
     {.place = "/config/seed", .is_right = &Json::is_number_integer, .rule = "a whole number"},
     {.place = "/config/camera/width_px",
      .is_right = &Json::is_number_integer,
      .rule = "a whole number",
      .may_lack = true},
     {.place = "/config/camera/height_px",
      .is_right = &Json::is_number_integer,
      .rule = "a whole number",
      .may_lack = true},
     {.place = "/config/sensor/kelvin_per_count", .is_right = &Json::is_number, .rule = "a number"},
     {.place = "/config/sensor/preset", .is_right = &Json::is_string, .rule = "text", .may_lack = true},
     {.place = "/config/sensor/model", .is_right = &Json::is_string, .rule = "text", .may_lack = true},
     {.place = "/annotations_sha256", .is_right = &Json::is_string, .rule = "text", .may_lack = true}}};

void check_values(const Json& dataset, const std::string& file) {
  for (const KnownValue& value : kKnown) {
    const Json::json_pointer place(value.place);
    const bool is_there = dataset.contains(place);
    if (is_there ? (dataset.at(place).*value.is_right)() : value.may_lack) continue;
    std::string name = &value.place[1];
    std::ranges::replace(name, '/', '.');
    throw DataError(
        fault(file + ": " + name, is_there ? brief(dataset.at(place)) : "nothing", "", value.rule));
  }
}

void check_clips(const Json& dataset, const std::string& file) {
  const std::string list = "clips";
  std::set<std::string> seen;
  const auto clips = dataset.find(list);
  if (clips == dataset.end() || !clips->is_array())
    throw DataError(
        fault(file + ": clips", clips == dataset.end() ? "missing" : brief(*clips), "", "a list"));
  for (std::size_t i = 0; i < clips->size(); ++i) {
    const JsonEntry clip((*clips)[i], file, list, i);
    const std::string id = clip.text("id");
    if (!RelativeName::part_of(id)) throw clip.fault_of("id", RelativeName::kPartRule);
    if (!seen.insert(id).second) throw clip.fault_of("id", "each id once");
    const std::string status = clip.text("status");
    if (status == "failed") (void)clip.text("reason");
    const bool is_done = status == "done";
    if (is_done || (*clips)[i].contains("record_sha256")) (void)clip.text("record_sha256");
    if (is_done || (*clips)[i].contains("frames")) (void)clip.count("frames");
  }
}

}  // namespace

Json read_dataset_file(const Path& root) {
  const Layout layout{root};
  for (const Path& place : {layout.dataset_json(), layout.annotations_json(), layout.clips()})
    check_is_no_link(place);
  const Path file = layout.dataset_json();
  Json dataset = read_as_data(file);
  if (!dataset.is_object() || dataset.value("format", Json()) != "veldt-dataset")
    throw DataError(file.string() + " does not belong to a Veldt dataset");
  check_version(dataset, file.string(), 1);
  check_clips(dataset, file.string());
  check_values(dataset, file.string());
  return dataset;
}

}  // namespace thermal
