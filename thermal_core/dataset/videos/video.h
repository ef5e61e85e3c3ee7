#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dataset/progress.h"
#include "dataset/videos/kelvin_scale.h"
#include "io/assets.h"
#include "io/system/files.h"

namespace thermal {

/// Maximum number of clips in a video.
inline constexpr std::size_t kMostClips = 16;

/// Contents and options of a video.
struct VideoRequest {
  Path source;  ///< a dataset, or a clip's folder in one
  Path beside;  ///< another dataset, whose clips of the same ids are shown side by side; empty: none
  Path out;     ///< .mp4: a video; .png, .jpg, .jpeg: one frame of it
  std::vector<std::string> clips;  ///< ids; none: all that are finished
  std::string palette = "white_hot";
  bool boxes = false;
  bool tracks = false;
  bool scale = false;                ///< a bar of temperatures
  std::optional<KelvinRange> range;  ///< ir16 on a fixed scale, instead of ir8
  std::optional<int> frame;          ///< of pictures: index; none: the middle one
  int width_px = 0;                  ///< of the whole; 0: 1280 for one column of clips, else 1920
  Assets assets;
};

/// Result of make_video().
struct VideoOutcome {
  int frames = 0;  ///< written
  double seconds = 0;
  std::size_t clips = 0;  ///< shown
  int width_px = 0;
  int height_px = 0;
  std::size_t bytes = 0;
  std::vector<std::string> not_made;  ///< clips left out because they are not finished
};

/// Makes a video, or a picture of one frame, for viewing. The frame rate is the highest of the clips; slower ones
/// repeat frames, and shorter ones their last. Memory grows only with the frames' metadata. The same request gives the
/// same bytes with the same versions of x264 and FreeType. ConfigError for invalid requests, DataError or IoError for
/// damaged or missing files, TryAgainError when the disk is full, Cancelled.
VideoOutcome make_video(const VideoRequest& request, const RunHooks& hooks);

}  // namespace thermal
