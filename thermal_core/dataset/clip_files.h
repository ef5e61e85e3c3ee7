#pragma once

#include <functional>
#include <string>

#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {

/// Calls `take` with each line of a clip's frames.jsonl. DataError with file and line if one is not JSON, or lacks a
/// value that `take` reads; IoError if the file cannot be read.
void for_frame_lines(const Path& file, const std::function<void(const Json& frame)>& take);

/// A clip's folder in an untrusted dataset. All functions: DataError with file, location and value for departures from
/// DATASET.md; IoError if a file cannot be read, is not regular, or is a link.

/// Calls `take` with each line of frames.jsonl, after checking that the folder contains no link. Checked: frame_index,
/// which increases, time_s, ffc, and camera_to_world where it is not null.
void for_clip_frames(const Path& folder,
                     const std::function<void(int frame_index, const Json& values)>& take);

/// Calls `take` with each annotation of labels.json, its frame and its category's name. Checked: track_id, bbox, area,
/// ignore, and segmentation, but not its run lengths. Memory is that of the annotations' text.
void for_clip_labels(const Path& folder,
                     const std::function<void(int frame_index, const std::string& category,
                                              const std::string& annotation)>& take);

}  // namespace thermal
