#pragma once

#include <cstdint>
#include <memory>

#include "io/files.h"
#include "io/pass_buffer.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Limits on what a file of passes may claim, checked before memory is taken for it.
struct ReadLimits {
  std::int64_t pixels = 256'000'000;  ///< of a plane
};

/// Reads the frames of one clip, whatever its manifest says they are: EXR index planes, an EXR cryptomatte, or pictures
/// (PNG) of index numbers or of colours.
class PassReader {
 public:
  /// DataError if the manifest's cryptomatte or colours cannot be meant.
  explicit PassReader(const Manifest& manifest, const ReadLimits& limits = {});
  ~PassReader();
  PassReader(PassReader&&) noexcept;
  PassReader& operator=(PassReader&&) noexcept;

  /// The planes of one frame that are needed, and no others; of the size that the manifest's camera, supersample and
  /// overscan make. DataError naming the file and, where there is one, channel and pixel; IoError if it cannot be read.
  /// Safe to call from several threads.
  [[nodiscard]] Passes read(const Path& file, const PassNeeds& needs) const;

  /// The same into a buffer's passes.
  void read(const Path& file, const PassNeeds& needs, PassBuffer& out) const;

  /// Which planes beside the object index this file has; reads no pixels. The same faults.
  [[nodiscard]] PassNeeds planes_in(const Path& file) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace thermal
