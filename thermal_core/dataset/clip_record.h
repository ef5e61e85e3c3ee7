#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/json_file.h"

namespace thermal {

/// A frame that could not be converted, and that the clip goes without.
struct SkippedFrame {
  int frame_index = 0;
  std::string file;    ///< of the passes, without its folder
  std::string reason;  ///< without the file's name

  [[nodiscard]] bool operator==(const SkippedFrame&) const = default;
};

/// What a finished clip says of itself: clips/<clip>/clip.json.
struct ClipRecord {
  std::string clip;
  std::string season;
  std::uint32_t seed = 1;
  int frames = 0;  ///< that were made
  int annotations = 0;
  double frame_rate_hz = 9;
  std::string pixels_sha256;                 ///< of the frames' own sums, in order: ir8, ir16, ir8, …
  std::map<std::string, std::string> files;  ///< SHA-256 of every other file of the clip's folder
  std::vector<SkippedFrame> skipped = {};    ///< by rising index
};

[[nodiscard]] Json to_json(const ClipRecord& record);

/// DataError naming the file if it is not a clip's record.
[[nodiscard]] ClipRecord read_clip_record(const Path& file);

}  // namespace thermal
