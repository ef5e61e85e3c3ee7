#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "dataset/videos/grid.h"

namespace thermal {

/// A box of a target in the picture shown, and the tag that belongs to it.
struct Tagged {
  PixelRect box;
  PixelSize tag;
  std::int64_t track = 0;  ///< the same target in other frames
};

/// Where a tag is shown.
struct TagPlace {
  PixelRect tag;
  bool led = false;  ///< it is so far off that a line leads to its box
};

/// Finds places for tags beside boxes, inside a picture, so that they cover neither boxes nor each other where that
/// can be avoided; a place is kept from frame to frame where it is still free.
class TagPlacer {
 public:
  /// `picture`: tags stay within. `gap_px`: between box and tag.
  TagPlacer(const PixelRect& picture, int gap_px) : picture_(picture), gap_px_(gap_px) {}

  /// Places of the tags of one frame, in their order. A tag larger than the picture starts at its top left.
  [[nodiscard]] std::vector<TagPlace> place(const std::vector<Tagged>& tags);

 private:
  [[nodiscard]] TagPlace candidate(const Tagged& tagged, std::size_t number) const;
  [[nodiscard]] double cost_of(const TagPlace& place, const Tagged& owner, const std::vector<Tagged>& tags,
                               const std::vector<TagPlace>& placed) const;
  [[nodiscard]] std::size_t best_for(const Tagged& owner, const std::vector<Tagged>& tags,
                                     const std::vector<TagPlace>& placed) const;

  PixelRect picture_;
  int gap_px_;
  std::map<std::int64_t, std::size_t> last_;  ///< number of the candidate by track
};

/// Pixels that two rectangles have in common.
[[nodiscard]] double overlap_px(const PixelRect& a, const PixelRect& b) noexcept;

}  // namespace thermal
