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

/// How something is drawn.
struct Ink {
  PaletteColour colour{};
  double opacity = 1;
};

/// Lines of text as pictures, kept for the next frame.
class Letters {
 public:
  explicit Letters(const Assets& assets) : fonts_(assets.folder("fonts")) {}

  /// Good until trim().
  [[nodiscard]] const TextPicture& picture(const std::string& text, int size_px, bool bold = false);
  [[nodiscard]] int width_px(const std::string& text, int size_px, bool bold = false);
  /// Forgets all if there are many; between frames.
  void trim();
  /// Height of capital letters.
  [[nodiscard]] int capital_px(int size_px) { return picture("H", size_px).baseline_px; }
  /// The text, or as much of its start as is no wider, with "..." at the end.
  [[nodiscard]] std::string shortened(const std::string& text, int size_px, bool bold, int most_px);

 private:
  Path fonts_;
  std::map<std::tuple<int, bool, std::string>, TextPicture> pictures_;
};

[[nodiscard]] cv::Rect to_cv(const PixelRect& rect);

/// Pictures are 8 bits, blue, green, red. Everything may reach out of them.
void fill(cv::Mat& picture, const PixelRect& rect, const Ink& ink);

/// Lays ink over a picture as far as a mask of 8 bits says. `at`: the mask's top left corner.
void blend(cv::Mat& picture, const cv::Mat& mask, const cv::Point& at, const Ink& ink);

/// `at`: where the first letter stands on the baseline.
void write(cv::Mat& picture, const TextPicture& text, const cv::Point& at, const Ink& ink);

/// From the bottom to the top; `at`: where the first letter's baseline begins, its left side on the right.
void write_upwards(cv::Mat& picture, const TextPicture& text, const cv::Point& at, const Ink& ink);

/// The frame of a rectangle, all of it outside.
void outline(cv::Mat& picture, const PixelRect& rect, int width_px, const Ink& ink);

/// A point of a line, and how opaque the line is from there on.
struct LinePoint {
  double x_px = 0;
  double y_px = 0;
  double opacity = 1;
};

/// An anti-aliased line through points, inside `room` alone and outside `hole`. Points may be anywhere.
void draw_line(cv::Mat& picture, const PixelRect& room, const PixelRect& hole,
               const std::vector<LinePoint>& points, int width_px, const Ink& ink);

}  // namespace thermal
