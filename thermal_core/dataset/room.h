#pragma once

#include <cstdint>
#include <string>

#include "io/config.h"

namespace thermal {

/// How much of a clip is on the disk, and with that how much is still to come.
struct ClipRoom {
  /// Files of one kind, one a frame.
  struct Files {
    std::int64_t worst_bytes = 0;  ///< of one, for as long as there is none
    std::int64_t bytes = 0;        ///< of those there are
    int count = 0;

    void add(std::int64_t file_bytes) {
      bytes += file_bytes;
      ++count;
    }
    /// The mean of those there are, rounded up, else the worst.
    [[nodiscard]] std::int64_t bytes_a_frame() const;
  };

  int frames = 0;
  Files passes;
  Files pictures;  ///< ir8 and ir16 together

  /// Bytes of the frames that are still to come.
  [[nodiscard]] std::int64_t needed_bytes() const;
};

/// A clip of which nothing is there yet. `pictures`: whether it is converted, too.
[[nodiscard]] ClipRoom room_for(const Config& config, const ClipConfig& clip, bool pictures);

/// "850 kB", "85 MB", "1.2 GB": two digits or more; kB is 1000 bytes and the least.
[[nodiscard]] std::string bytes_in_words(std::int64_t bytes);

/// TryAgainError where less than twice what is needed is left. `folder` and `whose` are for its words.
void check_room(std::int64_t left_bytes, std::int64_t needed_bytes, const std::string& folder,
                const std::string& whose);

}  // namespace thermal
