#include "analysis/compare/comparison_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "analysis/compare/comparison.h"
#include "base/order_statistics.h"
#include "io/html_page.h"
#include "io/image/pictures.h"
#include "io/image/png.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

Json boxes_json(const std::vector<LabelBox>& boxes) {
  Json json = Json::array();
  for (const LabelBox& box : boxes) json.push_back({box.x_px, box.y_px, box.width_px, box.height_px});
  return json;
}

std::string png_of(const Plane<std::uint8_t>& picture) {
  const std::vector<std::byte> bytes = encode_png(picture);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return "data:image/png;base64," + base64_of(text);
}

/// A frame, or for temperatures its grey levels, as a data URL.
std::string shown(const FrameSource& source, std::size_t frame) {
  constexpr int kMostPx = 640;
  if (!source.kelvin)
    return "data:image/jpeg;base64," + base64_of(as_jpeg(source.frames[frame].file, kMostPx));
  const Plane<float> levels = read_levels(source, frame);
  Plane<std::uint8_t> picture(levels.width_px(), levels.height_px());
  std::ranges::transform(levels.pixels(), picture.pixels().begin(),
                         [](float level) { return static_cast<std::uint8_t>(std::lround(level)); });
  return png_of(picture);
}

Json frames_json(const SetFigures& set) {
  constexpr std::size_t kShown = 6;
  Json frames = Json::array();
  for (const std::size_t k : evenly(set.frames.size(), kShown)) {
    const FrameFigures& frame = set.frames[k];
    const SourceFrame& source = set.source.frames[frame.frame];
    frames.push_back({{"name", source.name},
                      {"width_px", frame.width_px},
                      {"height_px", frame.height_px},
                      {"boxes", boxes_json(source.boxes)},
                      {"picture", shown(set.source, frame.frame)}});
  }
  return frames;
}

/// A target and its surroundings, as a PNG with their original pixels.
Json crop_json(const Plane<float>& frame, const LabelBox& box) {
  const auto inside = [](double place, int most) {
    return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(most)));
  };
  const int left = inside(std::floor(box.x_px) - kRingPx, frame.width_px() - 1);
  const int top = inside(std::floor(box.y_px) - kRingPx, frame.height_px() - 1);
  const int right = inside(std::ceil(box.x_px + box.width_px) + kRingPx, frame.width_px());
  const int bottom = inside(std::ceil(box.y_px + box.height_px) + kRingPx, frame.height_px());
  Plane<std::uint8_t> crop(right - left, bottom - top);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x)
      crop.at(x - left, y - top) = static_cast<std::uint8_t>(std::lround(frame.at(x, y)));
  }
  return {{"picture", png_of(crop)},
          {"width_px", crop.width_px()},
          {"height_px", crop.height_px()},
          {"box", {box.x_px - left, box.y_px - top, box.width_px, box.height_px}}};
}

Json crops_json(const SetFigures& set) {
  constexpr std::size_t kShown = 24;
  std::vector<std::pair<std::size_t, LabelBox>> targets;
  for (const FrameFigures& frame : set.frames) {
    for (const TargetCrop& crop : frame.crops) targets.emplace_back(frame.frame, crop.box);
  }
  Json crops = Json::array();
  for (const std::size_t k : evenly(targets.size(), kShown))
    crops.push_back(crop_json(read_levels(set.source, targets[k].first), targets[k].second));
  return crops;
}

}  // namespace

std::string comparison_page(const Comparison& comparison, const Assets& assets) {
  Json figures = to_json(comparison, false);
  for (const auto& [key, set] :
       {std::pair("real", &comparison.real), std::pair("dataset", &comparison.other)}) {
    figures[key]["shown_frames"] = frames_json(*set);
    figures[key]["shown_crops"] = crops_json(*set);
  }
  return html_page(figures,
                   {.title = comparison.other.source.name,
                    .kind = "Veldt comparison",
                    .scripts = {"elements.js", "charts.js", "compare.js"}},
                   assets);
}

}  // namespace thermal
