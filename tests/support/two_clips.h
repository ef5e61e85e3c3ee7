#pragma once

#include "dataset/clip/record.h"
#include "io/json/file.h"

/// A dataset of two clips, "a" and "b", without pictures; what is written of them is synthetic.
namespace two_clips {

inline const std::vector<std::string> kIds = {"a", "b"};

/// What an index reads of its config.
inline thermal::Json document() {
  return {{"name", "night"}, {"seed", 1}, {"sensor", {{"kelvin_per_count", 0.01}}}};
}

inline thermal::Json labels(const std::string& id) {
  return {{"categories", thermal::Json::array()},
          {"videos", {{{"id", 1}, {"name", id}}}},
          {"images", thermal::Json::array()},
          {"annotations", thermal::Json::array()}};
}

/// Writes the files of a complete clip into a folder that exists.
inline thermal::ClipRecord write(const thermal::Path& folder, const std::string& id, int frames = 2) {
  thermal::ClipRecord record;
  record.season = "winter";
  record.clip = id;
  record.frames = frames;
  record.annotations = 1;
  record.pixels_sha256 = "of " + id;
  thermal::write_file_atomically(folder / "clip.json", thermal::to_text(to_json(record)));
  thermal::write_file_atomically(folder / "labels.json", thermal::to_text(labels(id)));
  return record;
}

}  // namespace two_clips
