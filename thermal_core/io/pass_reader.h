#pragma once

#include <memory>

#include "io/pass_buffer.h"
#include "io/system/files.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Reads the frames of one clip in any format that its manifest declares: EXR index planes, an EXR cryptomatte, or
/// pictures (PNG) of index numbers or of colours.
class PassReader {
 public:
  /// DataError if the manifest's cryptomatte or colours are invalid.
  explicit PassReader(const Manifest& manifest, const ReadLimits& limits = {});
  ~PassReader();
  PassReader(PassReader&&) noexcept;
  PassReader& operator=(PassReader&&) noexcept;

  /// Reads the planes of one frame that are needed, and no others, at the size given by the manifest's camera,
  /// supersample and overscan. DataError with the file and, where known, channel and pixel; IoError if it cannot be
  /// read. Safe to call from several threads.
  [[nodiscard]] Passes read(const Path& file, const PassNeeds& needs) const;

  /// The same into a buffer's passes.
  void read(const Path& file, const PassNeeds& needs, PassBuffer& out) const;

  /// Which planes besides the object index this file has; reads no pixels. The same faults.
  [[nodiscard]] PassNeeds planes_in(const Path& file) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace thermal
