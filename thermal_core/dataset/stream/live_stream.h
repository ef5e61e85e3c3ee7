#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dataset/stream/frame_stream.h"
#include "dataset/stream/lateness.h"
#include "io/assets.h"

namespace thermal {

struct LiveStreamOptions {
  Path plan;  ///< as World needs it
  Assets assets;
  std::vector<std::string> clips = {};  ///< in the plan's order; empty: all
  NetAddress video;
  std::optional<NetAddress> lines = {};
  std::optional<double> frame_rate_hz = {};  ///< of all cameras; empty: each clip's
  bool repeat = false;                       ///< from the first clip again, until the run is stopped
};

/// What became of a clip's frames.
struct StreamedClip {
  std::string clip;
  double frame_rate_hz = 0;
  int sent = 0;
  int late = 0;     ///< left out, because those before took too long
  int dropped = 0;  ///< made, but not sent
  std::int64_t lines_missed = 0;
  std::int64_t clients_refused = 0;
  Lateness lateness = {};
  std::string fault = {};  ///< of FrameStream::Counts

  [[nodiscard]] int frames() const noexcept { return sent + late + dropped; }
};

/// Flies the planned flights as they are timed, and sends what their cameras take, with a line of JSON each. A frame that
/// cannot be made in time is left out: the camera's clock goes on. `done` is called after each clip, and after one that is
/// stopped; `state` every five seconds while it is sent. Returns when all is sent, or stopped().
///
/// Between clips nothing is sent while the next one's place is built, for seconds; a single clip that is repeated begins
/// again at once.
///
/// With each clip's own frame rate, frames are those of `generate`, bit for bit, before the first that is left out. At
/// another rate the camera moves on straight lines between the planned frames.
/// ConfigError as of World and FrameStream; IoError as of FrameStream.
void stream_flights(const LiveStreamOptions& options, const std::function<bool()>& stopped,
                    const std::function<void(const StreamedClip&)>& state,
                    const std::function<void(const StreamedClip&)>& done);

}  // namespace thermal
