#include "dataset/view/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/version.h"
#include "dataset/clip/record.h"
#include "dataset/exports/export_folder.h"
#include "dataset/videos/clip_film.h"
#include "dataset/videos/kelvin_scale.h"
#include "dataset/videos/palette.h"
#include "dataset/videos/trails.h"
#include "io/json/entry.h"
#include "io/json/file.h"
#include "io/system/sha256.h"
#include "labels/rle.h"

namespace thermal {
namespace {

/// Masks of a clip's labels by the labels' ids: COCO's compressed run lengths, in columns of the whole frame.
using ClipMasks = std::unordered_map<LabelId, std::string>;

/// Inputs of a clip's frames on the page; all must outlive it.
struct FrameParts {
  const ClipFilm& film;
  const ClipMasks& masks;
  const Trails& trails;
  double kelvin_per_count = 0;
};

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

/// Reads the masks of a clip's labels.json; labels without run lengths have none. DataError "FILE:
/// annotations[3].segmentation = …" unless run lengths cover a frame of the film exactly.
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

/// Data of a clip that the page shows before it loads a frame: name, size, rate, categories with their colours, targets
/// (tracks) by category, and as runs of frame indices, [first, count]: all frames (`frames`), those with the shutter
/// closed (`closed`), and those with labels (`seen`).
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

/// Data of one frame on the page: time, height, shutter, the temperatures where levels 1 and 255 begin (unless the gain
/// control is local), labels with their masks, trails thinned to two points a second, and both PNG files unchanged in
/// base64. DataError or IoError naming the file, if one is damaged or of another size.
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

constexpr const char* kViewRecord = "view.json";
constexpr const char* kViewFormat = "veldt-view";
constexpr const char* kPage = "index.html";

/// Files of the page, copied from assets/, by their folder there.
constexpr std::array<std::pair<const char*, const char*>, 11> kCode = {{{"report", "style.css"},
                                                                        {"report", "elements.js"},
                                                                        {"view", "view.css"},
                                                                        {"view", "png.js"},
                                                                        {"view", "frames.js"},
                                                                        {"view", "masks.js"},
                                                                        {"view", "drawing.js"},
                                                                        {"view", "panels.js"},
                                                                        {"view", "keys.js"},
                                                                        {"view", "screen.js"},
                                                                        {"view", "page.js"}}};

/// A script that passes JSON to a function of the page. ASCII, so that its bytes mean the same in any encoding.
std::string call_of(const char* function, const Json& json) {
  return fmt::format("{}({});\n", function, json.dump(-1, ' ', true, Json::error_handler_t::replace));
}

bool is_view(const Path& folder) {
  try {
    check_is_no_link(folder / kViewRecord);
    return read_json(folder / kViewRecord).value("format", Json()) == kViewFormat;
  } catch (const Error&) {
    return false;
  } catch (const Json::exception&) {  // not an object
    return false;
  }
}

void check_view_out(const Path& out) {
  const auto fault_of = [&out](const char* rule) {
    return ConfigError(fault("--out", fmt::format("\"{}\"", out.string()), "", rule));
  };
  if (out.extension() == ".html") throw fault_of("the name of a folder, in which the page is index.html");
  if (!std::filesystem::exists(out)) return;
  if (!std::filesystem::is_directory(out)) throw fault_of("a folder");
  if (!std::filesystem::is_empty(out) && !is_view(out))
    throw fault_of("an empty or new folder, or the page of an earlier veldt view");
}

Json palettes_of_page() {
  Json palettes = Json::array();
  for (const std::string& name : palette_names()) {
    std::string bytes;
    for (const PaletteColour& colour : palette_table(name)) bytes.append(colour.begin(), colour.end());
    palettes.push_back({{"name", name}, {"colours", base64_of(bytes)}});
  }
  return palettes;
}

std::int64_t bytes_below(const Path& folder) {
  std::int64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += static_cast<std::int64_t>(entry.file_size());
  return bytes;
}

/// Writes the files of one page.
class ViewWriter {
 public:
  ViewWriter(const FilmedDataset& dataset, Path folder, const RunHooks& hooks)
      : dataset_(dataset), folder_(std::move(folder)), hooks_(hooks) {}

  void write_code(const Assets& assets) const {
    make_folder(folder_ / "code");
    for (const auto& [kind, name] : kCode) copy_content(assets.folder(kind) / name, folder_ / "code" / name);
    copy_content(assets.folder("view") / kPage, folder_ / kPage);
  }

  void write_clips(const std::vector<std::string>& ids) {
    std::vector<ClipRecord> records;
    for (const std::string& id : ids)
      records.push_back(read_clip_record(dataset_.layout.clip(id) / "clip.json"));
    std::int64_t frames = 0;
    for (const ClipRecord& record : records) frames += record.frames;
    progress_.total = static_cast<int>(std::min<std::int64_t>(frames, std::numeric_limits<int>::max()));
    for (std::size_t k = 0; k < ids.size(); ++k) write_clip(ids[k], records[k].season);
  }

  /// Writes the list of clips, and finally the record.
  ViewOutcome finish(const std::vector<std::string>& not_made) {
    write_text(Path("data") / "dataset.js",
               call_of("takeDataset", {{"name", dataset_.name},
                                       {"kelvin_per_count", dataset_.kelvin_per_count},
                                       {"palettes", palettes_of_page()},
                                       {"trail_s", kTrailSeconds},
                                       {"clips", clips_},
                                       {"not_made", not_made}}));
    write_text(kViewRecord, to_text({{"format", kViewFormat},
                                     {"version", 1},
                                     {"veldt_version", kVersion},
                                     {"dataset", dataset_.name},
                                     {"clips", clips_.size()},
                                     {"frames", frames_}}));
    return {.page = {},
            .clips = clips_.size(),
            .frames = frames_,
            .bytes = bytes_below(folder_),
            .not_made = not_made};
  }

 private:
  void write_clip(const std::string& id, const std::string& season) {
    const ClipFilm film = read_clip_film(dataset_, id, true);
    const ClipMasks masks = read_clip_masks(film);
    const Trails trails(film, kTrailSeconds);
    const FrameParts parts{
        .film = film, .masks = masks, .trails = trails, .kelvin_per_count = dataset_.kelvin_per_count};
    make_folder(folder_ / "data" / id);
    progress_.clip = id;
    constexpr std::size_t kInFlight = 8;
    run_pipeline(kInFlight, [&film](std::size_t number) { return number < film.frames.size(); },
                 {{.in_order = false, .work = [&](std::size_t number) { write_frame(parts, number); }},
                  {.in_order = true, .work = [this](std::size_t) { pass_frame(); }}});
    clips_.push_back(clip_figures(film, dataset_.camera_of(id), season));
    frames_ += film.frames.size();
  }

  void write_frame(const FrameParts& parts, std::size_t number) const {
    const std::string name = fmt::format("{:06}.js", parts.film.frames[number].frame_index);
    write_text(Path("data") / parts.film.id / name, call_of("takeFrame", frame_figures(parts, number)));
  }

  void write_text(const Path& name, const std::string& text) const {
    write_file(folder_ / name, std::as_bytes(std::span(text)));
  }

  void pass_frame() {
    if (hooks_.stop_wanted()) throw Cancelled();
    ++progress_.done;
    hooks_.report(progress_);
  }

  const FilmedDataset& dataset_;
  Path folder_;
  const RunHooks& hooks_;
  Progress progress_;
  Json clips_ = Json::array();
  std::size_t frames_ = 0;
};

std::vector<std::string> without_repeats(const std::vector<std::string>& ids) {
  std::vector<std::string> once;
  for (const std::string& id : ids)
    if (std::ranges::find(once, id) == once.end()) once.push_back(id);
  return once;
}

}  // namespace

ViewOutcome write_view(const ViewRequest& request, const RunHooks& hooks) {
  const Path out = named_folder(request.out);
  check_view_out(out);
  const ClipSource source = find_clip_source(request.source, request.clips);
  ExportFolder folder(out, {});
  ViewWriter writer(source.dataset, folder.path(), hooks);
  writer.write_code(request.assets);
  writer.write_clips(without_repeats(source.clips));
  ViewOutcome outcome = writer.finish(source.not_made());
  folder.finish_in_place_of_old();
  outcome.page = out / kPage;
  return outcome;
}

}  // namespace thermal
