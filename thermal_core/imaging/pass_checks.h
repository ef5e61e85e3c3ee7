#pragma once

#include <cstdint>

#include "imaging/row_terms.h"

namespace thermal {

/// Usability of a plane at pixels that show a surface.
struct PlaneCheck {
  std::int64_t pixels = 0;    ///< that show a surface, in frames whose plane was read
  std::int64_t unusable = 0;  ///< of those

  /// 0 if no pixel was checked.
  [[nodiscard]] double share() const noexcept {
    return pixels == 0 ? 0 : static_cast<double>(unusable) / static_cast<double>(pixels);
  }
  PlaneCheck& operator+=(const PlaneCheck& other) noexcept;
  [[nodiscard]] bool operator==(const PlaneCheck&) const = default;
};

/// Usability of the planes that the terms read. Sky is not counted: renderers write anything there.
struct PassChecks {
  PlaneCheck depth;  ///< unusable: NaN, or outside of kDistanceM
  PlaneCheck
      normal;  ///< unusable: NaN, infinite, or of length 0. Means of several normals, which are short, are usable

  PassChecks& operator+=(const PassChecks& other) noexcept;
  [[nodiscard]] bool operator==(const PassChecks&) const = default;
};

/// Checks the planes that a row has.
[[nodiscard]] PassChecks check_row(const Row& row) noexcept;

}  // namespace thermal
