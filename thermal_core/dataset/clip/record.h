#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/json/file.h"
#include "sensor/agc.h"

namespace thermal {

/// The entry of frames.jsonl on how a frame's 8 bits were made from its 16: the mode, its parameters, and the
/// thresholds, which define it exactly (see ToneCurve). There are none in mode clahe.
[[nodiscard]] Json tone_record(const ToneCurve& curve, const AgcParameters& agc, float brightest_w_m2_sr);

/// Spelled as in configs.
[[nodiscard]] std::string mode_name(AgcMode mode);

/// A frame that could not be converted and is missing from the clip.
struct SkippedFrame {
  int frame_index = 0;
  std::string file;    ///< of the passes, without its folder
  std::string reason;  ///< without the file's name

  [[nodiscard]] bool operator==(const SkippedFrame&) const = default;
};

/// The record of a finished clip: `clips/<clip>/clip.json`.
struct ClipRecord {
  std::string clip;
  std::string season;
  std::uint32_t seed = 1;
  int frames = 0;  ///< finished ones
  int annotations = 0;
  double frame_rate_hz = 9;
  std::string pixels_sha256;  ///< of the frames' checksums, in order: ir8, ir16, ir8, …
  /// identity_of() its passes; empty if they were rendered for this dataset
  std::string made_from_sha256 = {};
  std::map<std::string, std::string> files;  ///< SHA-256 of every other file of the clip's folder
  std::vector<SkippedFrame> skipped = {};    ///< in ascending order
  /// Share of the pixels of surfaces whose depth, or normal, is unusable (PassChecks), over all converted frames; empty
  /// if no term reads that plane or no frame shows a surface.
  std::optional<double> unusable_depth_share = {};
  std::optional<double> unusable_normal_share = {};
};

/// The content of clip.json.
[[nodiscard]] Json to_json(const ClipRecord& record);

/// Adds unusable_depth_share and unusable_normal_share, if they are known.
void add_unusable(const ClipRecord& record, Json& json);

/// DataError with the file if it is not a clip's record, or names files that a clip does not have.
[[nodiscard]] ClipRecord read_clip_record(const Path& file);

}  // namespace thermal
