#pragma once

#include <vector>

namespace thermal {

/// A rectangle of whole pixels.
struct PixelRect {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  [[nodiscard]] int right_px() const noexcept { return x_px + width_px; }
  [[nodiscard]] int bottom_px() const noexcept { return y_px + height_px; }
  [[nodiscard]] bool operator==(const PixelRect&) const = default;
};

/// Width and height of a picture.
struct PixelSize {
  int width_px = 0;
  int height_px = 0;
};

/// What a video shows at once.
struct GridRequest {
  std::vector<PixelSize> frames;  ///< of each clip, row by row; at least one
  int columns = 0;                ///< 0: as many as make the whole nearest to 16:9
  int width_px = 0;               ///< of the whole; 0: 1280 for one column, else 1920; at least 160 a column
  bool bar = false;               ///< a bar of temperatures beside each picture
  bool headings = false;          ///< a line of text over each column
};

/// Where one clip is shown.
struct GridCell {
  PixelRect caption;  ///< over the picture
  PixelRect picture;  ///< of the frame's shape
  PixelRect bar;      ///< with its labels, to the right of the picture; empty if there is none
};

/// Where clips stand in a video.
struct Grid {
  int width_px = 0;  ///< of the whole; both even, as video wants them
  int height_px = 0;
  int text_px = 0;  ///< size of letters
  int columns = 0;
  std::vector<GridCell> cells;      ///< of each clip
  std::vector<PixelRect> headings;  ///< of each column; empty if there are none
};

/// Places of everything in a video. Cells are equally large; a picture fills as much of its cell as its shape lets it.
[[nodiscard]] Grid make_grid(const GridRequest& request);

}  // namespace thermal
