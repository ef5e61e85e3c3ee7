#include "dataset/clip_record.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"

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
  add_unusable(record, json);
  for (const SkippedFrame& frame : record.skipped) json["skipped"].push_back(to_json(frame));
  return json;
}

ClipRecord read_clip_record(const Path& file) {
  try {
    const Json json = read_json(file);
    return {.clip = json.at("clip"),
            .season = json.at("season"),
            .seed = json.at("seed"),
            .frames = json.at("frames"),
            .annotations = json.at("annotations"),
            .frame_rate_hz = json.at("frame_rate_hz"),
            .pixels_sha256 = json.at("pixels_sha256"),
            .files = json.at("files").get<std::map<std::string, std::string>>(),
            .skipped = read_skipped(json),
            .unusable_depth_share = read_share(json, "unusable_depth_share"),
            .unusable_normal_share = read_share(json, "unusable_normal_share")};
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("{}: not a clip record: {}", file.string(), error.what()));
  }
}

}  // namespace thermal
