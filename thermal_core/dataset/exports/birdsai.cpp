#include "dataset/exports/birdsai.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/label_files/birdsai.h"

namespace thermal {
namespace {

/// The whole pixels that cover [low, low + length]: first, and number. Rounding errors of sums do not add a pixel.
struct Span {
  long first_px = 0;
  long count_px = 0;
};

Span span_of(double low_px, double length_px) {
  constexpr double kRoundingsPx = 1e-6;
  const long first_px = std::lround(std::floor(low_px + kRoundingsPx));
  return {.first_px = first_px,
          .count_px = std::lround(std::ceil(low_px + length_px - kRoundingsPx)) - first_px};
}

std::string row_of(const LabelSet& set, const Label& label) {
  const Span x = span_of(label.box.x_px, label.box.width_px);
  const Span y = span_of(label.box.y_px, label.box.height_px);
  const BirdsaiKind kind = birdsai_kind(set.categories[label.category].name);
  return fmt::format("{},{},{},{},{},{},{},{},{:d},{:d}\n", set.images[label.image].frame_index,
                     *label.track_id, x.first_px, y.first_px, x.count_px, y.count_px, kind.animal_or_human,
                     kind.species, label.occluded.value_or(false), label.noisy);
}

std::string rows_of(const LabelSet& set, std::size_t first, std::size_t end) {
  std::vector<const Label*> labels;
  for (std::size_t k = first; k < end; ++k)
    if (why_not_in_birdsai(set, set.labels[k]).empty()) labels.push_back(&set.labels[k]);
  std::ranges::sort(labels, {}, [](const Label* label) { return *label->track_id; });
  std::string text;
  for (const Label* label : labels) text += row_of(set, *label);
  return text;
}

}  // namespace

std::string why_not_in_birdsai(const LabelSet& set, const Label& label) {
  if (label.crowd) return "of crowds, which BIRDSAI cannot mark";
  return kind_of(set.categories[label.category].name) == Kind::vehicle
             ? "of vehicles, which BIRDSAI has no class for"
             : "";
}

ExportPlan plan_birdsai(const ExportInput& input) {
  const LabelSet& set = input.set;
  check_tracks(set, "birdsai");
  const std::vector<std::size_t> first = first_labels(set);
  ExportPlan plan;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    const LabelImage& image = set.images[i];
    const std::string clip = file_name_of(set.videos[image.video].name);
    const std::string folder = input.split_asked ? input.splits[input.of_video[image.video]] + "/" : "";
    if (i == 0 || image.video != set.images[i - 1].video) {
      check_in_time(set, image, "birdsai");
      plan.texts.push_back(
          {.to = fmt::format("{}annotations/{}.csv", folder, clip), .content = "", .of = image.file});
    }
    plan.texts.back().content += rows_of(set, first[i], first[i + 1]);
    plan.pictures.push_back({.image = i,
                             .to = fmt::format("{}images/{}/{}_{:010}{}", folder, clip, clip,
                                               image.frame_index, ending_of(image.file))});
  }
  return plan;
}

}  // namespace thermal
