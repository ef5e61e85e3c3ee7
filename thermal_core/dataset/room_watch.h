#pragma once

#include <mutex>

#include "dataset/layout.h"
#include "dataset/room.h"
#include "dataset/run_board.h"

namespace thermal {

/// Follows the files of a clip as they come, and tells what room the clip still needs; from any thread.
/// All throw TryAgainError where there is too little.
class RoomWatch {
 public:
  /// Counts the passes that an earlier run left. `pictures`: whether they are converted, too.
  RoomWatch(const Config& config, const ClipConfig& clip, const Layout& layout, bool pictures,
            RunBoard& board);

  /// So many leading frames of the passes are whole.
  void passes_ready(int frames);
  /// The pictures of one more frame are written.
  void pictures_written();

 private:
  void tell();

  std::string id_;
  Layout layout_;
  RunBoard& board_;
  std::mutex mutex_;
  ClipRoom room_;
};

}  // namespace thermal
