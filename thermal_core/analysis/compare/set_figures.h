#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/compare/edges.h"
#include "analysis/compare/frame_source.h"
#include "analysis/compare/frame_statistics.h"
#include "analysis/compare/noise.h"
#include "analysis/target_crop.h"
#include "base/image.h"

namespace thermal {

/// Figures of one frame.
struct FrameFigures {
  std::size_t frame = 0;  ///< index into FrameSource::frames
  std::size_t unit = 0;   ///< frames that are drawn together: see units_of()
  int width_px = 0;
  int height_px = 0;
  RadialPower power;
  GreyLevels grey;
  std::vector<Edge> edges;
  std::optional<FlatNoise> noise;
  Structure structure;
  std::vector<TargetCrop> crops;
};

/// Measures a frame of levels from 0 to 255; `frame` and `unit` of the result are 0.
[[nodiscard]] FrameFigures measure_frame(const Plane<float>& levels, const std::vector<LabelBox>& boxes);

/// Noise of footage of a static scene.
struct StillFootage {
  VideoNoise noise;  ///< medians over the runs of frames
  std::size_t runs = 0;
};

/// A set of frames and their figures.
struct SetFigures {
  FrameSource source;
  std::vector<FrameFigures> frames;
  std::vector<std::string> rejected;  ///< messages: pictures that could not be read
  std::optional<StillFootage> still;  ///< empty: no run of frames shows a static scene
};

/// Frames of a run that is checked for a static scene.
inline constexpr std::size_t kStillFrames = 8;

/// Levels of a frame: kelvins are mapped from KelvinLevels::lowest_k to levels from 0 to 255; other frames have their
/// grey levels on the scale of 8 bits, those of 16 bits divided by 257. DataError with the file for frames below 16 x
/// 16 px, and those of read_grey_picture() and read_kelvin_picture().
[[nodiscard]] Plane<float> read_levels(const FrameSource& source, std::size_t frame);

/// Sets common levels for two sources in kelvin, from the 0.1 to the 99.9 % points of the temperatures of up to 16
/// frames of each, evenly spaced. Pictures that cannot be read are left out.
void set_common_levels(FrameSource& one, FrameSource& other);

/// Reads and measures at most `most_frames` of a source, evenly spaced. Frames keep their sizes. `show` is called as
/// frames are done. DataError if fewer than 4 can be read.
[[nodiscard]] SetFigures measure_set(FrameSource source, std::size_t most_frames,
                                     const std::function<void(std::size_t done, std::size_t total)>& show);

/// Units of frames: each picture of a folder is one. Those of a dataset are its clips if it has at least 10; otherwise
/// clips are split into equal runs of frames, for about 10 units.
[[nodiscard]] std::vector<std::size_t> units_of(const FrameSource& source,
                                                const std::vector<std::size_t>& frames);

/// Medians over the targets seen from a band of heights.
struct AltitudeRow {
  double from_m = 0;
  double to_m = 0;  ///< excluded
  std::size_t targets = 0;
  double width_px = 0;
  double height_px = 0;
  double contrast = 0;
  double ring_deviation = 0;
};

/// Bands of 20 m around 20, 40, 60 … m that have targets; empty without known heights.
[[nodiscard]] std::vector<AltitudeRow> targets_by_altitude(const SetFigures& set);

/// Of one figure of targets.
struct MeanAndDeviation {
  double mean = 0;
  double deviation = 0;
};

/// Margins of boxes round warm blobs: see BoxMargins.
struct MarginRow {
  double from_px = 0;
  double to_px = 0;  ///< excluded; 0: no limit
  std::size_t targets = 0;
  MeanAndDeviation left_px;
  MeanAndDeviation right_px;
  MeanAndDeviation top_px;
  MeanAndDeviation bottom_px;
};

/// Size by which targets are grouped: the longer side of the blob, or of the box.
enum class MarginsBy { blob, box };

/// Non-empty rows, from 0, 6, 9, 12, 16, 20, 26 and 40 px up.
[[nodiscard]] std::vector<MarginRow> margins_by_size(const SetFigures& set, MarginsBy by);

/// Targets of all frames, those with known margins, and labelled boxes too small to be targets.
struct TargetCounts {
  std::size_t boxes = 0;
  std::size_t targets = 0;
  std::size_t with_margins = 0;
};
/// Counts of a set's targets.
[[nodiscard]] TargetCounts target_counts(const SetFigures& set);

}  // namespace thermal
