#pragma once

// Private to this folder: OpenCV's types are in no other header.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <opencv2/core.hpp>

#include "dataset/videos/clip_film.h"
#include "dataset/videos/grid.h"
#include "dataset/videos/kelvin_scale.h"
#include "dataset/videos/palette.h"
#include "dataset/videos/trails.h"
#include "io/assets.h"
#include "io/image/pictures.h"

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

inline constexpr PaletteColour kBackground = {14, 17, 22};
inline constexpr PaletteColour kBright = {236, 240, 243};
inline constexpr PaletteColour kDim = {150, 161, 172};

/// Options for drawing clips.
struct CellStyle {
  PaletteTable palette{};
  bool boxes = false;
  bool tracks = false;
  std::optional<KelvinRange> range;  ///< otherwise each frame's own gain control
  int text_px = 16;
};

/// Draws one clip into its cell of the video, frame by frame in order.
class CellPainter {
 public:
  /// Arguments must outlive this. `dataset`: for the camera's name, and the clip's `kelvin_per_count`.
  CellPainter(const ClipFilm& film, const GridCell& cell, const CellStyle& style,
              const FilmedDataset& dataset, Letters& letters);

  /// `number`: index of a frame of the film.
  void paint(std::size_t number, cv::Mat& picture);

 private:
  [[nodiscard]] Plane<std::uint8_t> levels_of(std::size_t number) const;
  [[nodiscard]] KelvinScale scale_of(const FilmFrame& frame) const;
  [[nodiscard]] PixelRect shown(const LabelBox& box) const;
  /// Box of a track's label in a frame; empty without one.
  [[nodiscard]] PixelRect box_of(std::size_t number, std::int64_t track) const;
  void paint_frame(std::size_t number, cv::Mat& picture) const;
  [[nodiscard]] std::vector<std::string> facts_of(const FilmFrame& frame) const;
  void paint_caption(const FilmFrame& frame, cv::Mat& picture);
  void paint_bar(const KelvinScale& scale, cv::Mat& picture);
  void paint_tracks(std::size_t number, cv::Mat& picture) const;
  void paint_boxes(std::size_t number, cv::Mat& picture);
  void paint_tags(const std::vector<const Label*>& labels, bool shutter_closed, cv::Mat& picture);
  [[nodiscard]] PixelRect shutter_plate();
  void paint_shutter(cv::Mat& picture);
  [[nodiscard]] PaletteColour colour_of(std::size_t category) const;
  [[nodiscard]] std::string tag_of(const Label& label) const;

  const ClipFilm& film_;
  const GridCell& cell_;
  const CellStyle& style_;
  const FilmedDataset& dataset_;
  Letters& letters_;
  double scale_;  ///< pixels of the video per pixel of the frame
  int line_px_;
  std::vector<std::uint8_t> levels_of_counts_;  ///< empty without a range
  std::optional<Trails> trails_;
  TagPlacer placer_;
};

}  // namespace thermal
