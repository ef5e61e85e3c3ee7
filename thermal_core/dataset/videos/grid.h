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

/// Request for the layout of a video.
struct GridRequest {
  std::vector<PixelSize> frames;  ///< of each clip, row by row; at least one
  int columns = 0;                ///< 0: for an aspect ratio of the whole closest to 16:9
  int width_px = 0;               ///< of the whole; 0: 1280 for one column, else 1920; at least 160 a column
  bool bar = false;               ///< a bar of temperatures beside each picture
  bool headings = false;          ///< a line of text over each column
};

/// Layout of one clip.
struct GridCell {
  PixelRect caption;  ///< over the picture
  PixelRect picture;  ///< of the frame's aspect ratio
  PixelRect bar;      ///< including its labels, to the right of the picture; empty if there is none
};

/// Layout of all clips of a video.
struct Grid {
  int width_px = 0;  ///< of the whole; both even, for video
  int height_px = 0;
  int text_px = 0;  ///< size of letters
  int columns = 0;
  std::vector<GridCell> cells;      ///< of each clip
  std::vector<PixelRect> headings;  ///< of each column; empty if there are none
};

/// Computes the layout of a video. Cells have equal sizes; a picture is as large as its shape allows.
[[nodiscard]] Grid make_grid(const GridRequest& request);

}  // namespace thermal
