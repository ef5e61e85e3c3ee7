#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "dataset/videos/clip_film.h"
#include "dataset/videos/trails.h"
#include "io/json/file.h"

namespace thermal {

/// Masks of a clip's labels by the labels' ids: COCO's compressed run lengths, in columns of the whole frame.
using ClipMasks = std::unordered_map<LabelId, std::string>;

/// Reads the masks of a clip's labels.json; labels without run lengths have none. DataError "FILE:
/// annotations[3].segmentation = …" unless run lengths cover a frame of the film exactly.
[[nodiscard]] ClipMasks read_clip_masks(const ClipFilm& film);

/// Data of a clip that the page shows before it loads a frame: name, size, rate, categories with their colours, targets
/// (tracks) by category, and as runs of frame indices, [first, count]: all frames (`frames`), those with the shutter
/// closed (`closed`), and those with labels (`seen`).
[[nodiscard]] Json clip_figures(const ClipFilm& film, const std::string& camera, const std::string& season);

/// Inputs of a clip's frames on the page; all must outlive it.
struct FrameParts {
  const ClipFilm& film;
  const ClipMasks& masks;
  const Trails& trails;
  double kelvin_per_count = 0;
};

/// Data of one frame on the page: time, height, shutter, the temperatures where levels 1 and 255 begin (unless the gain
/// control is local), labels with their masks, trails thinned to two points a second, and both PNG files unchanged in
/// base64. DataError or IoError naming the file, if one is damaged or of another size.
[[nodiscard]] Json frame_figures(const FrameParts& parts, std::size_t number);

}  // namespace thermal
