#pragma once

// Private to this folder: OpenCV's types are in no other header.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "dataset/videos/clip_film.h"
#include "dataset/videos/drawing.h"
#include "dataset/videos/grid.h"
#include "dataset/videos/kelvin_scale.h"
#include "dataset/videos/palette.h"
#include "dataset/videos/tag_positions.h"
#include "dataset/videos/trails.h"

namespace thermal {

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
