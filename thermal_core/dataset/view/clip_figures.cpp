#include "dataset/view/clip_figures.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/videos/kelvin_scale.h"
#include "dataset/videos/palette.h"
#include "io/json/entry.h"
#include "io/system/base64.h"
#include "labels/rle.h"

namespace thermal {
namespace {

/// Whether untrusted run lengths cover exactly one frame.
bool covers_frame(const Json& segmentation, const ClipFilm& film) {
  if (segmentation.value("size", Json()) != Json{film.height_px, film.width_px}) return false;
  const Json counts = segmentation.value("counts", Json());
  if (!counts.is_string()) return false;
  try {
    return covered_px(decode_coco_rle(counts.get_ref<const std::string&>())) ==
           std::int64_t{film.width_px} * film.height_px;
  } catch (const DataError&) {
    return false;
  }
}

/// Consecutive frame indices as [first, count].
class IndexRuns {
 public:
  void add(int index) {
    if (!runs_.empty() && runs_.back().first + runs_.back().second == index)
      ++runs_.back().second;
    else
      runs_.emplace_back(index, 1);
  }
  [[nodiscard]] Json json() const { return runs_; }

 private:
  std::vector<std::pair<int, int>> runs_;
};

std::string css_colour(const PaletteColour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

Json categories_of_clip(const LabelSet& set) {
  Json categories = Json::array();
  for (const LabelCategory& category : set.categories)
    categories.push_back({{"name", category.name}, {"colour", css_colour(category_colour(category.id))}});
  return categories;
}

/// A label without a track is a separate target.
Json targets_of_clip(const LabelSet& set) {
  std::map<std::size_t, std::set<std::pair<bool, LabelId>>> targets;
  for (const Label& label : set.labels)
    targets[label.category].emplace(label.track_id.has_value(),
                                    label.track_id ? LabelId(*label.track_id) : label.id);
  Json list = Json::array();
  for (const auto& [category, tracks] : targets)
    list.push_back({{"category", category}, {"count", tracks.size()}});
  return list;
}

double tenths(double value) { return std::round(10 * value) / 10; }

Json label_in_view(const Label& label, const ClipMasks& masks) {
  Json json = {{"category", label.category},
               {"box", {label.box.x_px, label.box.y_px, label.box.width_px, label.box.height_px}}};
  const auto add = [&json](const char* key, const auto& value) {
    if (value) json[key] = *value;
  };
  add("track", label.track_id);
  add("range_m", label.range_m);
  add("temperature_k", label.temperature_k);
  add("contrast_k", label.contrast_k);
  add("visibility", label.visibility);
  if (label.truncated) json["truncated"] = true;
  if (label.ignore) json["ignore"] = true;
  if (const auto mask = masks.find(label.id); mask != masks.end()) json["mask"] = mask->second;
  return json;
}

/// x, y and age, one point after another: the first of each half second of the clip, so that a trail is stable from
/// frame to frame, and the newest.
Json trail_in_view(const Trail& trail, double now_s) {
  constexpr double kStepSeconds = 0.5;
  constexpr double kRounding = 1e-6;
  Json points = Json::array();
  double last_step = -1;
  for (const TrailPoint& point : trail.points) {
    const double step = std::floor((now_s - point.age_s) / kStepSeconds + kRounding);
    if (step == last_step && &point != &trail.points.back()) continue;
    last_step = step;
    for (const double value : {point.x_px, point.y_px, point.age_s}) points.push_back(tenths(value));
  }
  return {{"category", trail.category}, {"track", trail.track}, {"points", std::move(points)}};
}

std::string embedded(const ClipFilm& film, const char* kind, const FilmFrame& frame) {
  return base64_of(read_file(film.folder / kind / frame_name(frame.frame_index)));
}

}  // namespace

ClipMasks read_clip_masks(const ClipFilm& film) {
  const std::string list = "annotations";
  const std::string file = (film.folder / "labels.json").string();
  ClipMasks masks;
  (void)read_json_elements(file, [&](const std::string& array, std::size_t entry_index, const Json& json) {
    if (array != list || !json.contains("segmentation") || !json["segmentation"].is_object()) return;
    const JsonEntry entry(json, file, list, entry_index);
    if (!covers_frame(json["segmentation"], film))
      throw entry.fault_of("segmentation",
                           fmt::format("run lengths of {} x {} px", film.width_px, film.height_px));
    masks[entry.id("id")] = json["segmentation"]["counts"];
  });
  return masks;
}

Json clip_figures(const ClipFilm& film, const std::string& camera, const std::string& season) {
  IndexRuns frames;
  IndexRuns closed;
  IndexRuns seen;
  for (std::size_t k = 0; k < film.frames.size(); ++k) {
    const FilmFrame& frame = film.frames[k];
    frames.add(frame.frame_index);
    if (frame.shutter_closed) closed.add(frame.frame_index);
    if (film.first_label[k] < film.first_label[k + 1]) seen.add(frame.frame_index);
  }
  return {{"id", film.id},
          {"season", season},
          {"camera", camera},
          {"frame_rate_hz", film.frame_rate_hz},
          {"width_px", film.width_px},
          {"height_px", film.height_px},
          {"black_hot", film.black_hot},
          {"agc_mode", film.agc_mode},
          {"frames", frames.json()},
          {"closed", closed.json()},
          {"seen", seen.json()},
          {"categories", categories_of_clip(film.labels)},
          {"targets", targets_of_clip(film.labels)}};
}

Json frame_figures(const FrameParts& parts, std::size_t number) {
  const ClipFilm& film = parts.film;
  const FilmFrame& frame = film.frames[number];
  (void)film.read_levels(number);  // reports damage now, and not in the page
  (void)film.read_counts(number);
  Json json = {{"clip", film.id}, {"frame", frame.frame_index}, {"time_s", frame.time_s}};
  if (frame.agl_m) json["agl_m"] = *frame.agl_m;
  if (frame.shutter_closed) json["closed"] = true;
  if (frame.thresholds) {
    const KelvinRange known = scale_of_curve(*frame.thresholds, parts.kelvin_per_count).known();
    json["levels_k"] = {known.low_k, known.high_k};
  }
  json["labels"] = Json::array();
  for (std::size_t k = film.first_label[number]; k < film.first_label[number + 1]; ++k)
    json["labels"].push_back(label_in_view(film.labels.labels[k], parts.masks));
  json["trails"] = Json::array();
  for (const Trail& trail : parts.trails.at(number))
    json["trails"].push_back(trail_in_view(trail, frame.time_s));
  json["ir8"] = embedded(film, "ir8", frame);
  json["ir16"] = embedded(film, "ir16", frame);
  return json;
}

}  // namespace thermal
