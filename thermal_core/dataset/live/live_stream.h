#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dataset/live/frame_stream.h"
#include "io/assets.h"

namespace thermal {

struct LiveStreamOptions {
  Path plan;  ///< a plan's folder for World
  Assets assets;
  std::vector<std::string> clips = {};  ///< in the plan's order; empty: all
  NetAddress video;
  std::optional<NetAddress> lines = {};
  std::optional<double> frame_rate_hz = {};  ///< of all cameras; empty: each clip's
  bool repeat = false;                       ///< repeat all clips until the run is stopped
};

/// Counts of a clip's frames.
struct StreamedClip {
  std::string clip;
  double frame_rate_hz = 0;
  int sent = 0;
  int late = 0;     ///< skipped, because earlier frames took too long
  int dropped = 0;  ///< made, but not sent
  std::int64_t lines_missed = 0;
  std::int64_t clients_refused = 0;
  Lateness lateness = {};
  std::string fault = {};  ///< of FrameStream::Counts

  [[nodiscard]] int frames() const noexcept { return sent + late + dropped; }
};

/// Flies the planned flights in real time, and sends the frames of their cameras, with a line of JSON each. A frame
/// that cannot be made in time is skipped: the camera's clock continues. `done` is called after each clip, also after a
/// stopped one; `state` every five seconds while a clip is sent. Returns when everything is sent, or stopped().
///
/// Between clips nothing is sent for the seconds that the next one's scene takes to build; a single repeated clip
/// restarts at once.
///
/// At a clip's own frame rate, frames equal those of `generate`, bit for bit, up to the first skipped one. At another
/// rate, camera positions are interpolated linearly between the planned frames.
/// ConfigError as World and FrameStream; IoError as FrameStream.
void stream_flights(const LiveStreamOptions& options, const std::function<bool()>& stopped,
                    const std::function<void(const StreamedClip&)>& state,
                    const std::function<void(const StreamedClip&)>& done);

}  // namespace thermal
