#include "dataset/clip/record.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "base/text.h"
#include "io/json/entry.h"

namespace thermal {

std::string mode_name(AgcMode mode) {
  switch (mode) {
    case AgcMode::scene_max:
      return "scene_max";
    case AgcMode::table_max:
      return "table_max";
    case AgcMode::linear:
      return "linear";
    case AgcMode::percentile:
      return "percentile";
    case AgcMode::plateau:
      return "plateau";
    case AgcMode::information:
      return "information";
    case AgcMode::clahe:
      return "clahe";
  }
  return "";
}

Json tone_record(const ToneCurve& curve, const AgcParameters& agc, float brightest_w_m2_sr) {
  Json record = {{"mode", mode_name(agc.mode)},
                 {"polarity", agc.polarity == Polarity::black_hot ? "black_hot" : "white_hot"},
                 {"low_k", curve.low_k},
                 {"high_k", curve.high_k}};
  if (agc.mode == AgcMode::scene_max || agc.mode == AgcMode::table_max) {
    record["brightest_w_m2_sr"] = brightest_w_m2_sr;
  }
  if (!curve.is_local) record["thresholds"] = curve.thresholds;
  return record;
}

namespace {

Json to_json(const SkippedFrame& frame) {
  return {{"frame_index", frame.frame_index}, {"file", printable(frame.file)}, {"reason", frame.reason}};
}

std::vector<SkippedFrame> read_skipped(const Json& record, const std::string& file) {
  const std::string list = "skipped";
  std::vector<SkippedFrame> frames;
  for (const Json& frame : record.value(list, Json::array())) {
    const JsonEntry entry(frame, file, list, frames.size());
    frames.push_back({.frame_index = entry.count("frame_index"),
                      .file = entry.text("file"),
                      .reason = entry.text("reason")});
  }
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
  constexpr std::int64_t kMostSeed = std::numeric_limits<std::uint32_t>::max();
  const std::string name = file.string();
  try {
    const Json json = read_json(file);
    const JsonEntry entry(json, name);
    check_version(json, name, 1);
    ClipRecord record = {.clip = entry.text("clip"),
                         .season = entry.text("season"),
                         .seed = static_cast<std::uint32_t>(entry.whole_number("seed", kMostSeed)),
                         .frames = entry.count("frames"),
                         .annotations = entry.count("annotations"),
                         .frame_rate_hz = entry.number("frame_rate_hz"),
                         .pixels_sha256 = entry.text("pixels_sha256"),
                         .made_from_sha256 = json.value("made_from_sha256", std::string()),
                         .files = json.at("files").get<std::map<std::string, std::string>>(),
                         .skipped = read_skipped(json, name),
                         .unusable_depth_share = entry.optional_number("unusable_depth_share"),
                         .unusable_normal_share = entry.optional_number("unusable_normal_share")};
    check_names(record, file);
    return record;
  } catch (const ConfigError& error) {
    throw DataError(error.what());
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("{}: not a clip record: {}", name, error.what()));
  }
}

}  // namespace thermal
