#include "analysis/compare/set_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/order_statistics.h"
#include "base/parallel.h"
#include "io/image/kelvin_picture.h"
#include "io/image/pictures.h"

namespace thermal {
namespace {

constexpr std::size_t kLeastFrames = 4;

FrameFigures measured(const FrameSource& source, std::size_t frame) {
  FrameFigures figures = measure_frame(read_levels(source, frame), source.frames[frame].boxes);
  figures.frame = frame;
  return figures;
}

/// Figures of a frame, or why it was rejected.
struct Attempt {
  std::optional<FrameFigures> figures;
  std::string fault;
};

Attempt attempted(const FrameSource& source, std::size_t frame) {
  try {
    return {measured(source, frame), ""};
  } catch (const DataError& error) {
    return {std::nullopt, error.what()};
  }
}

std::vector<Attempt> attempts_of(const FrameSource& source, const std::vector<std::size_t>& frames,
                                 const std::function<void(std::size_t, std::size_t)>& show) {
  constexpr std::size_t kBatch = 16;
  std::vector<Attempt> attempts(frames.size());
  for (std::size_t first = 0; first < frames.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, frames.size() - first);
    parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = first + begin; k < first + end; ++k) attempts[k] = attempted(source, frames[k]);
    });
    if (show) show(first + count, frames.size());
  }
  return attempts;
}

// --- footage of a static scene

/// First frames of runs that may show a static scene: at the start of some clips, or spread over a folder.
std::vector<std::size_t> starts_of(const FrameSource& source) {
  constexpr std::size_t kMostRuns = 4;
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k + kStillFrames <= source.frames.size(); ++k) {
    const bool one_clip = source.frames[k].video == source.frames[k + kStillFrames - 1].video;
    const bool starts_clip = k == 0 || source.frames[k].video != source.frames[k - 1].video;
    if (one_clip && (!source.is_dataset || starts_clip)) starts.push_back(k);
  }
  std::vector<std::size_t> chosen;
  for (const std::size_t k : evenly(starts.size(), kMostRuns)) chosen.push_back(starts[k]);
  return chosen;
}

/// Noise of a run, if its scene is static and all its frames can be read.
std::optional<VideoNoise> noise_of_run(const FrameSource& source, std::size_t start) {
  std::vector<Plane<float>> frames;
  try {
    for (std::size_t k = start; k < start + kStillFrames; ++k) frames.push_back(read_levels(source, k));
  } catch (const DataError&) {
    return {};
  }
  return is_still(frames) ? std::optional(video_noise(frames)) : std::nullopt;
}

std::optional<StillFootage> still_footage(const FrameSource& source) {
  std::vector<double> random;
  std::vector<double> rows;
  std::vector<double> columns;
  std::vector<double> whole;
  for (const std::size_t start : starts_of(source)) {
    const auto noise = noise_of_run(source, start);
    if (!noise) continue;
    random.push_back(noise->random);
    rows.push_back(noise->rows);
    columns.push_back(noise->columns);
    whole.push_back(noise->frames);
  }
  if (random.empty()) return {};
  const std::size_t runs = random.size();
  return StillFootage{{median_of(random), median_of(rows), median_of(columns), median_of(whole)}, runs};
}

/// On the scale of 8 bits.
Plane<float> grey_levels_of(const Path& file) {
  const GreyPicture picture = read_grey_picture(file);
  Plane<float> levels(picture.levels.width_px(), picture.levels.height_px());
  const float scale = picture.bits == 8 ? 1.0F : 1.0F / 257.0F;
  std::transform(picture.levels.pixels().begin(), picture.levels.pixels().end(), levels.pixels().begin(),
                 [scale](std::uint16_t level) { return static_cast<float>(level) * scale; });
  return levels;
}

Plane<float> kelvin_levels(const Path& file, const KelvinLevels& scale) {
  Plane<float> levels = read_kelvin_picture(file, scale.stored);
  for (float& level : levels.pixels()) {
    const double above = (static_cast<double>(level) - scale.lowest_k) / scale.kelvin_per_level;
    level = static_cast<float>(std::clamp(above, 0.0, kGreyLevels - 1.0));
  }
  return levels;
}

void widen_range(const FrameSource& source, double& lowest_k, double& highest_k) {
  constexpr std::size_t kFrames = 16;
  constexpr std::size_t kOutside = 1000;  // one pixel in this many is outside at each end
  for (const std::size_t frame : evenly(source.frames.size(), kFrames)) {
    try {
      Plane<float> kelvin = read_kelvin_picture(source.frames[frame].file, source.kelvin->stored);
      std::ranges::sort(kelvin.pixels());
      const std::size_t out = kelvin.size() / kOutside;
      lowest_k = std::min(lowest_k, static_cast<double>(kelvin.pixels()[out]));
      highest_k = std::max(highest_k, static_cast<double>(kelvin.pixels()[kelvin.size() - 1 - out]));
    } catch (const DataError&) {
      continue;  // reported when it is measured
    }
  }
}

}  // namespace

FrameFigures measure_frame(const Plane<float>& levels, const std::vector<LabelBox>& boxes) {
  FrameFigures figures = {.width_px = levels.width_px(),
                          .height_px = levels.height_px(),
                          .power = radial_power(levels),
                          .grey = grey_levels(levels),
                          .edges = straight_edges(levels),
                          .noise = flat_noise(levels),
                          .structure = structure_of(levels),
                          .crops = {}};
  for (const LabelBox& box : boxes) {
    if (const auto crop = target_crop(levels, box)) figures.crops.push_back(*crop);
  }
  return figures;
}

Plane<float> read_levels(const FrameSource& source, std::size_t frame) {
  constexpr int kLeastPx = 16;
  const Path& file = source.frames[frame].file;
  Plane<float> levels = source.kelvin ? kelvin_levels(file, *source.kelvin) : grey_levels_of(file);
  if (levels.width_px() < kLeastPx || levels.height_px() < kLeastPx)
    throw DataError(fault(file.string() + ": size",
                          fmt::format("{} x {}", levels.width_px(), levels.height_px()), "px",
                          fmt::format("at least {} x {} px", kLeastPx, kLeastPx)));
  return levels;
}

void set_common_levels(FrameSource& one, FrameSource& other) {
  double lowest_k = std::numeric_limits<double>::max();
  double highest_k = 0;
  for (const FrameSource* source : {&one, &other}) widen_range(*source, lowest_k, highest_k);
  constexpr double kLeastRangeK = 0.1;
  for (FrameSource* source : {&one, &other}) {
    source->kelvin->lowest_k = lowest_k;
    source->kelvin->kelvin_per_level = std::max(highest_k - lowest_k, kLeastRangeK) / (kGreyLevels - 1);
  }
}

std::vector<std::size_t> units_of(const FrameSource& source, const std::vector<std::size_t>& frames) {
  constexpr std::size_t kLeastUnits = 10;
  std::map<std::size_t, std::size_t> frames_in;  // by clip, number of the given frames
  for (const std::size_t frame : frames) ++frames_in[source.frames[frame].video];
  const std::size_t runs =
      source.is_dataset ? (kLeastUnits + frames_in.size() - 1) / frames_in.size() : frames.size();
  std::map<std::size_t, std::size_t> seen;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> numbers;
  std::vector<std::size_t> units;
  for (const std::size_t frame : frames) {
    const std::size_t clip = source.frames[frame].video;
    const std::size_t run = seen[clip]++ * runs / frames_in[clip];
    units.push_back(numbers.emplace(std::pair(clip, run), numbers.size()).first->second);
  }
  return units;
}

SetFigures measure_set(FrameSource source, std::size_t most_frames,
                       const std::function<void(std::size_t, std::size_t)>& show) {
  SetFigures set = {.source = std::move(source), .frames = {}, .rejected = {}, .still = {}};
  std::vector<std::size_t> read;
  for (Attempt& attempt : attempts_of(set.source, evenly(set.source.frames.size(), most_frames), show)) {
    if (!attempt.figures) {
      set.rejected.push_back(std::move(attempt.fault));
      continue;
    }
    read.push_back(attempt.figures->frame);
    set.frames.push_back(*std::move(attempt.figures));
  }
  if (read.size() < kLeastFrames) {
    std::string message = fault(set.source.name, std::to_string(read.size()), "frames that can be read",
                                fmt::format("at least {}", kLeastFrames));
    for (const std::string& rejected : set.rejected) message += "\n" + rejected;
    throw DataError(message);
  }
  const std::vector<std::size_t> units = units_of(set.source, read);
  for (std::size_t k = 0; k < units.size(); ++k) set.frames[k].unit = units[k];
  set.still = still_footage(set.source);
  return set;
}

namespace {

constexpr double kBandM = 20;
constexpr std::array kSizesPx = {0.0, 6.0, 9.0, 12.0, 16.0, 20.0, 26.0, 40.0};

using Crops = std::vector<const TargetCrop*>;

template <typename Value>
std::vector<double> values_in(const Crops& crops, const Value& value) {
  std::vector<double> values;
  for (const TargetCrop* crop : crops) values.push_back(value(*crop));
  return values;
}

AltitudeRow altitude_row(double from_m, const Crops& crops) {
  const auto median = [&crops](auto value) { return median_of(values_in(crops, value)); };
  return {.from_m = from_m,
          .to_m = from_m + kBandM,
          .targets = crops.size(),
          .width_px = median([](const TargetCrop& crop) { return crop.box.width_px; }),
          .height_px = median([](const TargetCrop& crop) { return crop.box.height_px; }),
          .contrast = median([](const TargetCrop& crop) { return crop.contrast; }),
          .ring_deviation = median([](const TargetCrop& crop) { return crop.ring_deviation; })};
}

MarginRow margin_row(std::size_t size, const Crops& crops) {
  const auto spread = [&crops](double BoxMargins::*side) {
    const std::vector<double> values =
        values_in(crops, [side](const TargetCrop& crop) { return (*crop.margins).*side; });
    return MeanAndDeviation{mean_of(values), deviation_of(values)};
  };
  return {.from_px = kSizesPx[size],
          .to_px = size + 1 < kSizesPx.size() ? kSizesPx[size + 1] : 0,
          .targets = crops.size(),
          .left_px = spread(&BoxMargins::left_px),
          .right_px = spread(&BoxMargins::right_px),
          .top_px = spread(&BoxMargins::top_px),
          .bottom_px = spread(&BoxMargins::bottom_px)};
}

double size_of(const TargetCrop& crop, MarginsBy by) {
  if (by == MarginsBy::box) return std::max(crop.box.width_px, crop.box.height_px);
  return std::max(crop.margins->blob_width_px, crop.margins->blob_height_px);
}

}  // namespace

std::vector<AltitudeRow> targets_by_altitude(const SetFigures& set) {
  std::map<double, Crops> bands;
  for (const FrameFigures& frame : set.frames) {
    const auto altitude_m = set.source.frames[frame.frame].altitude_m;
    if (!altitude_m) continue;
    const double from_m = kBandM * std::floor((*altitude_m + 0.5 * kBandM) / kBandM) - 0.5 * kBandM;
    for (const TargetCrop& crop : frame.crops) bands[from_m].push_back(&crop);
  }
  std::vector<AltitudeRow> rows;
  for (const auto& [from_m, crops] : bands) rows.push_back(altitude_row(from_m, crops));
  return rows;
}

std::vector<MarginRow> margins_by_size(const SetFigures& set, MarginsBy by) {
  std::array<Crops, kSizesPx.size()> sizes;
  for (const FrameFigures& frame : set.frames) {
    for (const TargetCrop& crop : frame.crops) {
      if (!crop.margins) continue;
      const auto above = std::upper_bound(kSizesPx.begin(), kSizesPx.end(), size_of(crop, by));
      sizes[static_cast<std::size_t>(above - kSizesPx.begin() - 1)].push_back(&crop);
    }
  }
  std::vector<MarginRow> rows;
  for (std::size_t size = 0; size < sizes.size(); ++size) {
    if (!sizes[size].empty()) rows.push_back(margin_row(size, sizes[size]));
  }
  return rows;
}

TargetCounts target_counts(const SetFigures& set) {
  TargetCounts counts;
  for (const FrameFigures& frame : set.frames) {
    counts.boxes += set.source.frames[frame.frame].boxes.size();
    counts.targets += frame.crops.size();
    counts.with_margins += static_cast<std::size_t>(
        std::count_if(frame.crops.begin(), frame.crops.end(),
                      [](const TargetCrop& crop) { return crop.margins.has_value(); }));
  }
  return counts;
}

}  // namespace thermal
