#include "dataset/exports/segments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "io/json/entry.h"
#include "labels/rle.h"

namespace thermal {
namespace {

constexpr std::int64_t kMostPixels = std::int64_t{64} << 20;  // enlarged, 256 MB
constexpr const char* kMaskRule = "run lengths of a mask, or polygons of three corners or more";

std::string where_of(const Json& annotation) {
  return fmt::format("annotation {}: segmentation", brief(annotation.at("id")));
}

DataError fault_of_mask(const Json& annotation, const char* rule = kMaskRule) {
  return DataError(fault(where_of(annotation), brief(annotation.value("segmentation", Json())), "", rule));
}

using Polygon = std::vector<double>;  // x, y, x, y, …

bool is_polygon(const Json& json) {
  constexpr double kMostPx = 1e8;
  const auto is_place = [](const Json& v) { return v.is_number() && std::abs(v.get<double>()) <= kMostPx; };
  return json.is_array() && json.size() >= 6 && json.size() % 2 == 0 && std::ranges::all_of(json, is_place);
}

std::vector<Polygon> polygons_in(const Json& annotation) {
  const Json& given = annotation.at("segmentation");
  if (given.empty() || !std::ranges::all_of(given, is_polygon)) throw fault_of_mask(annotation);
  return given.get<std::vector<Polygon>>();
}

bool has_polygons(const Json& annotation) { return annotation.value("segmentation", Json()).is_array(); }

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
  const auto refuse = [&annotation] { return fault_of_mask(annotation); };
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

SegmentMaker::SegmentMaker(const LabelSet& set, Segmentation wanted) : wanted_(wanted) {
  for (const Label& label : set.labels) {
    const LabelImage& image = set.images[label.image];
    targets_.emplace(label.id, Target{.size = label.size,
                                      .crowd = label.crowd,
                                      .width_px = image.width_px,
                                      .height_px = image.height_px});
  }
}

const SegmentMaker::Target& SegmentMaker::target_of(const Json& annotation) const {
  return targets_.at(label_id_in(annotation.at("id")));
}

Json SegmentMaker::segmentation_of(const Json& annotation) {
  const Json given = annotation.value("segmentation", Json());
  Json made = wanted_ == Segmentation::polygon ? polygons_of(annotation) : run_lengths_of(annotation);
  has_changed_ |= made != given;
  return made;
}

Json SegmentMaker::polygons_of(const Json& annotation) {
  const Target& target = target_of(annotation);
  if (target.crowd || has_polygons(annotation)) return annotation.value("segmentation", Json());
  const TargetMask mask = mask_of(annotation);
  const std::vector<Outline> outlines = edge_outlines(mask);
  figures_.add(target.size, edge_iou(mask, outlines));
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

Json SegmentMaker::run_lengths_of(const Json& annotation) const {
  if (is_run_lengths(annotation)) return annotation.at("segmentation");
  if (!has_polygons(annotation)) throw fault_of_mask(annotation);
  const Target& target = target_of(annotation);
  if (std::int64_t{target.width_px} * target.height_px > kMostPixels)
    throw fault_of_mask(annotation, "polygons in a picture of at most 64 million pixels");
  const std::vector<Polygon> polygons = polygons_in(annotation);
  return {{"size", {target.height_px, target.width_px}},
          {"counts", encode_coco_rle(mask_of_polygons(polygons, target.width_px, target.height_px))}};
}

Outline SegmentMaker::outline_of(const Json& annotation) {
  const Target& target = target_of(annotation);
  if (!has_polygons(annotation)) {
    const TargetMask mask = mask_of(annotation);
    Outline outline = filled_outline(mask);
    figures_.add(target.size, filled_iou(mask, outline));
    return outline;
  }
  std::vector<Outline> outlines;
  for (const Polygon& polygon : polygons_in(annotation)) {
    Outline& outline = outlines.emplace_back();
    for (std::size_t i = 0; i < polygon.size(); i += 2)
      outline.push_back({.x_px = polygon[i], .y_px = polygon[i + 1]});
  }
  Outline outline = joined_outline(outlines, target.width_px, target.height_px);
  if (outline.empty())
    throw fault_of_mask(annotation,
                        "polygons inside their picture, with at most 5000 corners if there are several");
  return outline;
}

}  // namespace thermal
