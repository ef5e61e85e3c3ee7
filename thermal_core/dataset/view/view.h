#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dataset/progress.h"
#include "io/assets.h"
#include "io/system/files.h"

namespace thermal {

/// Options of a page.
struct ViewRequest {
  Path source;  ///< a dataset, or a clip's folder in one
  Path out;     ///< folder of the page; new, empty, or of an earlier page, which is replaced
  std::vector<std::string> clips;  ///< ids; none: all that are finished
  Assets assets;
};

/// Result of write_view().
struct ViewOutcome {
  Path page;  ///< to be opened in a browser
  std::size_t clips = 0;
  std::size_t frames = 0;
  std::int64_t bytes = 0;
  std::vector<std::string> not_made;  ///< clips left out because they are not finished
};

/// Writes a page to look through a dataset's frames, for a browser without a server: index.html, its scripts in `code`,
/// and in `data` one script per frame, which the page loads when it shows the frame, with its labels and both PNG files
/// (4/3 of their size): a page opened from a file may run scripts beside it, but not fetch files. Memory grows only
/// with the frames' metadata. OUT is complete or unchanged; the same dataset gives the same bytes. ConfigError for an
/// OUT that holds anything but such a page, and for invalid requests; DataError or IoError for damaged or missing
/// files; TryAgainError when the disk is full or another run writes OUT; Cancelled.
ViewOutcome write_view(const ViewRequest& request, const RunHooks& hooks);

}  // namespace thermal
