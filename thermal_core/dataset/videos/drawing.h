#pragma once

// Private to this folder: OpenCV's types are in no other header.

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <opencv2/core.hpp>

#include "dataset/videos/grid.h"
#include "dataset/videos/palette.h"
#include "io/assets.h"
#include "io/image/text_picture.h"

namespace thermal {

/// Colour and opacity.
struct Ink {
  PaletteColour colour{};
  double opacity = 1;
};

/// Cache of rendered lines of text.
class Letters {
 public:
  explicit Letters(const Assets& assets) : fonts_(assets.folder("fonts")) {}

  /// Valid until trim().
  [[nodiscard]] const TextPicture& picture(const std::string& text, int size_px, bool bold = false);
  [[nodiscard]] int width_px(const std::string& text, int size_px, bool bold = false);
  /// Clears the cache if it is large; to be called between frames.
  void trim();
  /// Height of capital letters.
  [[nodiscard]] int capital_px(int size_px) { return picture("H", size_px).baseline_px; }
  /// The text, or as much of its start as fits, with "..." at the end.
  [[nodiscard]] std::string shortened(const std::string& text, int size_px, bool bold, int most_px);

 private:
  Path fonts_;
  std::map<std::tuple<int, bool, std::string>, TextPicture> pictures_;
};

[[nodiscard]] cv::Rect to_cv(const PixelRect& rect);

/// Pictures are 8 bits, blue, green, red. Drawing outside of them is clipped.
void fill(cv::Mat& picture, const PixelRect& rect, const Ink& ink);

/// Blends ink into a picture by an 8-bit mask. `at`: the mask's top left corner.
void blend(cv::Mat& picture, const cv::Mat& mask, const cv::Point& at, const Ink& ink);

/// `at`: the first letter's origin on the baseline.
void write(cv::Mat& picture, const TextPicture& text, const cv::Point& at, const Ink& ink);

/// Draws text upwards, rotated counter-clockwise; `at`: the first letter's origin on the baseline.
void write_upwards(cv::Mat& picture, const TextPicture& text, const cv::Point& at, const Ink& ink);

/// A border outside of a rectangle.
void outline(cv::Mat& picture, const PixelRect& rect, int width_px, const Ink& ink);

/// A point of a line, and the line's opacity from there on.
struct LinePoint {
  double x_px = 0;
  double y_px = 0;
  double opacity = 1;
};

/// An anti-aliased line through points, clipped to the inside of `clip` and the outside of `hole`. Points may be
/// anywhere.
void draw_line(cv::Mat& picture, const PixelRect& clip, const PixelRect& hole,
               const std::vector<LinePoint>& points, int width_px, const Ink& ink);

}  // namespace thermal
