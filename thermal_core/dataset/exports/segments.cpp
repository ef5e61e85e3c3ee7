#include "dataset/exports/segments.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "labels/rle.h"

namespace thermal {
namespace {

constexpr std::int64_t kMostPixels = std::int64_t{64} << 20;  // enlarged, 256 MB
constexpr const char* kMaskRule = "run lengths of a mask, as Veldt writes them";

std::string where_of(const Json& annotation) {
  return fmt::format("annotation {}: segmentation", brief(annotation.at("id")));
}

bool is_run_lengths(const Json& annotation) {
  const auto found = annotation.find("segmentation");
  return found != annotation.end() && found->is_object() && found->contains("counts") &&
         found->contains("size");
}

RunLengths counts_of(const Json& counts) {
  return counts.is_string() ? decode_coco_rle(counts.get_ref<const std::string&>())
                            : counts.get<RunLengths>();
}

TargetMask cut_mask(const RunLengths& counts, int width_px, int height_px) {
  int left = width_px, right = -1, top = height_px, bottom = -1;
  for_stretches(counts, height_px, [&](int x, int y, int long_px) {
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y + long_px - 1);
  });
  if (right < 0) return {};
  TargetMask mask = {.left_px = left - 1,
                     .top_px = top - 1,
                     .pixels = Plane<std::uint8_t>(right - left + 3, bottom - top + 3)};
  for_stretches(counts, height_px, [&](int x, int y, int long_px) {
    for (int row = y; row < y + long_px; ++row) mask.pixels.at(x - mask.left_px, row - mask.top_px) = 1;
  });
  return mask;
}

}  // namespace

void OutlineFigures::add(SizeClass size, double iou) {
  Figures& figures = figures_[static_cast<std::size_t>(size)];
  ++figures.targets;
  figures.sum += iou;
  figures.least = std::min(figures.least, iou);
}

Json OutlineFigures::json() const {
  Json json = Json::object();
  for (const SizeClass size : {SizeClass::small, SizeClass::medium, SizeClass::large})
    if (const Figures& figures = of(size); figures.targets > 0)
      json[size_class_name(size)] = {
          {"targets", figures.targets}, {"mean", figures.mean()}, {"least", figures.least}};
  return json;
}

TargetMask mask_of(const Json& annotation) {
  const auto refuse = [&] {
    const Json& given = annotation.value("segmentation", Json());
    return DataError(fault(where_of(annotation), brief(given), "", kMaskRule));
  };
  if (!is_run_lengths(annotation)) throw refuse();
  try {
    const Json& code = annotation.at("segmentation");
    const int height_px = code.at("size").at(0).get<int>();
    const int width_px = code.at("size").at(1).get<int>();
    const RunLengths counts = counts_of(code.at("counts"));
    const std::int64_t pixels = covered_px(counts);
    if (height_px < 1 || width_px < 1 || pixels != std::int64_t{height_px} * width_px || pixels > kMostPixels)
      throw refuse();
    TargetMask mask = cut_mask(counts, width_px, height_px);
    if (mask.pixels.empty()) throw refuse();
    return mask;
  } catch (const Json::exception&) {
    throw refuse();
  }
}

SegmentMaker::SegmentMaker(const LabelSet& set) {
  for (const Label& label : set.labels) sizes_.emplace(label.id, label.size);
}

Json SegmentMaker::polygons_of(const Json& annotation) {
  const Json& given = annotation.value("segmentation", Json());
  if (annotation.value("iscrowd", 0) != 0 || given.is_array()) return given;
  const TargetMask mask = mask_of(annotation);
  const std::vector<Outline> outlines = edge_outlines(mask);
  count(annotation, edge_iou(mask, outlines));
  Json polygons = Json::array();
  for (const Outline& outline : outlines) {
    Json& polygon = polygons.emplace_back(Json::array());
    for (const OutlinePoint& point : outline) {
      polygon.push_back(static_cast<int>(point.x_px));
      polygon.push_back(static_cast<int>(point.y_px));
    }
  }
  return polygons;
}

Outline SegmentMaker::outline_of(const Json& annotation) {
  const TargetMask mask = mask_of(annotation);
  Outline outline = filled_outline(mask);
  count(annotation, filled_iou(mask, outline));
  return outline;
}

void SegmentMaker::count(const Json& annotation, double iou) {
  figures_.add(sizes_.at(annotation.at("id").get<std::int64_t>()), iou);
}

}  // namespace thermal
