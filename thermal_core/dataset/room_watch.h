#pragma once

#include <mutex>

#include "dataset/layout.h"
#include "dataset/room.h"
#include "dataset/run_monitor.h"

namespace thermal {

/// Follows the files of a clip as they are written, and reports the disk space it still needs; from any thread. All
/// functions throw TryAgainError if there is too little.
class RoomWatch {
 public:
  /// Counts the passes left by an earlier run. `pictures`: whether they are also converted.
  RoomWatch(const Config& config, const ClipConfig& clip, const Layout& layout, bool pictures,
            RunMonitor& monitor);

  /// Records that this many leading frames of the passes are complete.
  void passes_ready(int frames);
  /// Records one more frame's pictures.
  void pictures_written();

 private:
  void report();

  std::string id_;
  Layout layout_;
  RunMonitor& monitor_;
  std::mutex mutex_;
  ClipRoom room_;
};

}  // namespace thermal
