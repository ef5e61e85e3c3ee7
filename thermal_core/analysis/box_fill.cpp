#include "analysis/box_fill.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "analysis/compare/order_statistics.h"
#include "analysis/compare/target_crop.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "dataset/label_pictures.h"
#include "dataset/label_source.h"
#include "io/image/grey_picture.h"

namespace thermal {
namespace {

constexpr std::size_t kMostPictures = 1000;
constexpr std::size_t kLeastBoxes = 20;

/// Labels that are not ignored, by picture; pictures without any are left out.
std::vector<std::vector<const Label*>> labels_by_picture(const LabelSet& set) {
  std::vector<std::vector<const Label*>> pictures(set.images.size());
  for (const Label& label : set.labels)
    if (!label.crowd && !label.ignore) pictures[label.image].push_back(&label);
  std::erase_if(pictures, [](const auto& labels) { return labels.empty(); });
  std::vector<std::vector<const Label*>> taken;
  for (const std::size_t k : evenly(pictures.size(), kMostPictures)) taken.push_back(std::move(pictures[k]));
  return taken;
}

void check_is_there(const LabelSet& set, const LabelImage& image, const Path& labels) {
  if (!std::filesystem::exists(Path(set.root) / image.file))
    throw DataError(
        fmt::format("{}: no picture {} in {}; expected the folder of its pictures as --like-frames",
                    labels.string(), image.file, set.root.empty() ? "." : set.root));
}

Plane<float> levels_in(const LabelSet& set, const LabelImage& image) {
  const GreyPicture picture = read_grey_picture(picture_of(set, image));
  Plane<float> levels(picture.levels.width_px(), picture.levels.height_px());
  std::ranges::copy(picture.levels.pixels(), levels.pixels().begin());
  return levels;
}

/// Empty if the target does not differ from its surroundings.
std::optional<BoxFill> fill_of(const Plane<float>& levels, const LabelBox& box) {
  constexpr double kLeastDeviations = 4;
  const auto crop = target_crop(levels, box);
  if (!crop || !crop->margins || crop->contrast < kLeastDeviations * crop->ring_deviation) return {};
  return BoxFill{std::min(1.0, crop->margins->blob_width_px / box.width_px),
                 std::min(1.0, crop->margins->blob_height_px / box.height_px)};
}

BoxFill median_fill(const std::vector<BoxFill>& fills) {
  std::vector<double> widths;
  std::vector<double> heights;
  for (const BoxFill& fill : fills) {
    widths.push_back(fill.width);
    heights.push_back(fill.height);
  }
  return {median_of(widths), median_of(heights)};
}

}  // namespace

MeasuredFills measure_drawn_fills(const Path& labels, const Path& frames) {
  LabelSet set = read_labels(labels);
  if (!frames.empty()) set.root = frames.string();
  const auto pictures = labels_by_picture(set);
  for (const auto& picture : pictures) check_is_there(set, set.images[picture.front()->image], labels);
  std::vector<std::vector<std::optional<BoxFill>>> found(pictures.size());
  parallel_for(pictures.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Plane<float> levels = levels_in(set, set.images[pictures[k].front()->image]);
      for (const Label* label : pictures[k]) found[k].push_back(fill_of(levels, label->box));
    }
  });
  MeasuredFills measured;
  std::vector<BoxFill> all;
  std::array<std::vector<BoxFill>, 3> of_kind;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    for (std::size_t i = 0; i < pictures[k].size(); ++i) {
      const std::string& category = set.categories[pictures[k][i]->category].name;
      const auto kind = static_cast<std::size_t>(kind_of(lower_case(category)));
      ++measured.kinds.at(kind).boxes;
      if (!found[k][i]) continue;
      ++measured.kinds.at(kind).measured;
      of_kind.at(kind).push_back(*found[k][i]);
      all.push_back(*found[k][i]);
    }
  }
  if (all.size() < kLeastBoxes)
    throw DataError(fault(labels.string(), fmt::format("{} boxes whose targets stand out", all.size()), "",
                          fmt::format("at least {}", kLeastBoxes)));
  const auto fill = [&](Kind kind) {
    const auto& own = of_kind.at(static_cast<std::size_t>(kind));
    return median_fill(own.size() < kLeastBoxes ? all : own);
  };
  measured.fills = {fill(Kind::human), fill(Kind::animal), fill(Kind::vehicle)};
  return measured;
}

}  // namespace thermal
