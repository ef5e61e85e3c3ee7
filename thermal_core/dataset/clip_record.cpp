#include "dataset/clip_record.h"

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {

Json to_json(const ClipRecord& record) {
  return {{"format", "veldt-clip"},
          {"version", 1},
          {"clip", record.clip},
          {"season", record.season},
          {"seed", record.seed},
          {"frames", record.frames},
          {"annotations", record.annotations},
          {"frame_rate_hz", record.frame_rate_hz},
          {"pixels_sha256", record.pixels_sha256},
          {"files", record.files}};
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
            .files = json.at("files").get<std::map<std::string, std::string>>()};
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("{}: not the record of a clip: {}", file.string(), error.what()));
  }
}

}  // namespace thermal
