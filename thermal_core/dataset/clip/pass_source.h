#pragma once

#include "io/pass_buffer.h"
#include "scene/passes.h"

namespace thermal {

/// Where the planes of a clip's frames come from, if not from files. Safe to call from several threads.
class PassSource {
 public:
  PassSource() = default;
  virtual ~PassSource() = default;
  PassSource(const PassSource&) = delete;
  PassSource& operator=(const PassSource&) = delete;

  /// Fills the planes of a frame that are needed; may fill others.
  virtual void read(int frame, const PassNeeds& needs, Passes& out) const = 0;
};

}  // namespace thermal
