#include "dataset/clip_record.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "base/relative_name.h"
#include "base/text.h"

namespace thermal {

namespace {

Json to_json(const SkippedFrame& frame) {
  return {{"frame_index", frame.frame_index}, {"file", printable(frame.file)}, {"reason", frame.reason}};
}

std::vector<SkippedFrame> read_skipped(const Json& record) {
  std::vector<SkippedFrame> frames;
  for (const Json& frame : record.value("skipped", Json::array()))
    frames.push_back(
        {.frame_index = frame.at("frame_index"), .file = frame.at("file"), .reason = frame.at("reason")});
  return frames;
}

/// "000012": at least six digits, as frame_name() writes them.
bool is_frame_number(std::string_view text) {
  return text.size() >= 6 && text.size() <= kMostDigits &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a clip's folder has a file of this name; merge and validate open no others.
bool is_clip_file(std::string_view name) {
  if (name == "frames.jsonl" || name == "labels.json" || name == "preview.mp4") return true;
  for (const std::string_view folder : {"ir8/", "ir16/"}) {
    if (name.starts_with(folder) && name.ends_with(".png") && name.size() > folder.size() + 4)
      return is_frame_number(name.substr(folder.size(), name.size() - folder.size() - 4));
  }
  return false;
}

void check_names(const ClipRecord& record, const Path& file) {
  if (!RelativeName::part_of(record.clip))
    throw DataError(fault(file.string() + ": clip", brief(record.clip), "", RelativeName::kPartRule));
  for (const auto& [name, sum] : record.files) {
    if (!is_clip_file(name))
      throw DataError(
          fault(file.string() + ": files", brief(name), "",
                "frames.jsonl, labels.json, preview.mp4, ir8/NNNNNN.png and ir16/NNNNNN.png only"));
  }
}

std::optional<double> read_share(const Json& record, const char* key) {
  if (!record.contains(key)) return std::nullopt;
  return record.at(key).get<double>();
}

}  // namespace

void add_unusable(const ClipRecord& record, Json& json) {
  if (record.unusable_depth_share) json["unusable_depth_share"] = *record.unusable_depth_share;
  if (record.unusable_normal_share) json["unusable_normal_share"] = *record.unusable_normal_share;
}

Json to_json(const ClipRecord& record) {
  Json json = {{"format", "veldt-clip"},
               {"version", 1},
               {"clip", record.clip},
               {"season", record.season},
               {"seed", record.seed},
               {"frames", record.frames},
               {"annotations", record.annotations},
               {"frame_rate_hz", record.frame_rate_hz},
               {"pixels_sha256", record.pixels_sha256},
               {"files", record.files}};
  if (!record.made_from_sha256.empty()) json["made_from_sha256"] = record.made_from_sha256;
  add_unusable(record, json);
  for (const SkippedFrame& frame : record.skipped) json["skipped"].push_back(to_json(frame));
  return json;
}

ClipRecord read_clip_record(const Path& file) {
  check_has_no_links(file.parent_path());
  try {
    const Json json = read_json(file);
    ClipRecord record = {.clip = json.at("clip"),
                         .season = json.at("season"),
                         .seed = json.at("seed"),
                         .frames = json.at("frames"),
                         .annotations = json.at("annotations"),
                         .frame_rate_hz = json.at("frame_rate_hz"),
                         .pixels_sha256 = json.at("pixels_sha256"),
                         .made_from_sha256 = json.value("made_from_sha256", std::string()),
                         .files = json.at("files").get<std::map<std::string, std::string>>(),
                         .skipped = read_skipped(json),
                         .unusable_depth_share = read_share(json, "unusable_depth_share"),
                         .unusable_normal_share = read_share(json, "unusable_normal_share")};
    check_names(record, file);
    return record;
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("{}: not a clip record: {}", file.string(), error.what()));
  }
}

}  // namespace thermal
