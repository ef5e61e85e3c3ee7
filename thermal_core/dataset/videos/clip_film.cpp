#include "dataset/videos/clip_film.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "dataset/clip/record.h"
#include "io/image/pictures.h"
#include "io/image/png.h"
#include "io/json/file.h"
#include "io/label_files/coco.h"

namespace thermal {
namespace {

std::string camera_name(const Json& document) {
  const Json& sensor = document.at("sensor");
  return sensor.value("preset", sensor.value("model", ""));
}

/// Json's own conversion accepts fractions and numbers that are too large.
int whole_number(const Json& value, const char* name, int most) {
  const bool is_whole = value.is_number_integer() && value.get<std::int64_t>() >= 0;
  if (!is_whole || value.get<std::int64_t>() > most)
    throw DataError(fault(name, brief(value), "", fmt::format("a whole number from 0 to {}", most)));
  return value.get<int>();
}

std::array<std::uint16_t, kLevels - 1> read_thresholds(const Json& json) {
  constexpr int kMostCounts = 65535;
  std::array<std::uint16_t, kLevels - 1> thresholds{};
  for (std::size_t k = 0; k < thresholds.size(); ++k)
    thresholds[k] = static_cast<std::uint16_t>(whole_number(json.at(k), "agc.thresholds", kMostCounts));
  if (!std::ranges::is_sorted(thresholds))
    throw DataError("agc.thresholds fall; expected them in rising order");
  return thresholds;
}

FilmFrame read_frame(const Json& json) {
  constexpr int kMostFrames = 1'000'000'000;
  FilmFrame frame;
  frame.frame_index = whole_number(json.at("frame_index"), "frame_index", kMostFrames);
  frame.time_s = json.at("time_s");
  if (json.contains("agl_m")) frame.agl_m = json["agl_m"].get<double>();
  if (json.contains("camera_to_world"))
    frame.camera_to_world = json["camera_to_world"].get<std::array<double, 16>>();
  frame.shutter_closed = json.at("ffc");
  const Json& agc = json.at("agc");
  if (agc.at("mode") != "clahe") frame.thresholds = read_thresholds(agc.at("thresholds"));
  return frame;
}

void read_frames(ClipFilm& film) {
  const Path file = film.folder / "frames.jsonl";
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    const auto where = [&] { return fmt::format("{}:{}: ", file.string(), film.frames.size() + 1); };
    try {
      const Json json = Json::parse(line);
      film.frames.push_back(read_frame(json));
      film.black_hot = json.at("agc").at("polarity") == "black_hot";
      film.agc_mode = json.at("agc").at("mode");
    } catch (const Json::exception& error) {
      throw DataError(where() + "not a frame of a clip: " + error.what());
    } catch (const DataError& error) {
      throw DataError(where() + error.what());
    }
    const std::size_t count = film.frames.size();
    if (count > 1 && film.frames[count - 2].frame_index >= film.frames.back().frame_index)
      throw DataError(fmt::format("{}:{}: frame_index = {}; expected rising ones", file.string(), count,
                                  film.frames.back().frame_index));
  }
  if (film.frames.empty()) throw DataError(file.string() + " has no frames; expected at least one");
}

std::optional<FilmCamera> read_camera(const Path& labels) {
  std::optional<FilmCamera> camera;
  (void)read_json_elements(labels, [&](const std::string& array, std::size_t, const Json& entry) {
    if (array != "videos" || camera || !entry.contains("camera")) return;
    const Json& json = entry["camera"];
    camera = FilmCamera{.fx_px = json.at("fx_px"),
                        .fy_px = json.at("fy_px"),
                        .cx_px = json.at("cx_px"),
                        .cy_px = json.at("cy_px")};
    constexpr std::array kNames = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
    for (std::size_t k = 0; k < kNames.size(); ++k) camera->distortion[k] = json.value(kNames[k], 0.0);
  });
  return camera;
}

/// Index of the first label of each frame.
std::vector<std::size_t> places_of_labels(const LabelSet& set, const std::vector<FilmFrame>& frames) {
  std::vector<std::size_t> first;
  std::size_t label = 0;
  for (const FilmFrame& frame : frames) {
    while (label < set.labels.size() && set.images[set.labels[label].image].frame_index < frame.frame_index)
      ++label;
    first.push_back(label);
  }
  while (label < set.labels.size() &&
         set.images[set.labels[label].image].frame_index == frames.back().frame_index)
    ++label;
  first.push_back(label);
  return first;
}

void read_labels_of(ClipFilm& film) {
  const Path file = film.folder / "labels.json";
  film.labels = read_coco(file);
  film.first_label = places_of_labels(film.labels, film.frames);
  try {
    film.camera = read_camera(file);
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("{}: camera: {}", file.string(), error.what()));
  }
}

template <typename T>
void check_size(const Plane<T>& picture, const ClipFilm& film, const Path& file) {
  if (picture.width_px() == film.width_px && picture.height_px() == film.height_px) return;
  throw DataError(fmt::format("{} has {} x {} px; expected {} x {} px as the clip's first frame",
                              file.string(), picture.width_px(), picture.height_px(), film.width_px,
                              film.height_px));
}

}  // namespace

FilmedDataset read_filmed_dataset(const Path& root) {
  FilmedDataset dataset{
      .layout = {root}, .name = {}, .camera = {}, .own_cameras = {}, .clips = {}, .made = {}};
  const Path file = dataset.layout.dataset_json();
  if (!dataset.layout.is_begun())
    throw IoError(fmt::format(
        "{}{}", root.string(),
        std::filesystem::exists(root)
            ? " is not a dataset; expected a folder with dataset.json, or a clip's folder, DIR/clips/CLIP"
            : " does not exist"));
  const Json record = read_dataset_file(root);
  try {
    dataset.name = record.at("config").at("name");
    dataset.camera = camera_name(record.at("config"));
    for (const Json& clip : record.at("config").value("clips", Json::array()))
      if (clip.contains("sensor") && clip["sensor"].contains("preset"))
        dataset.own_cameras[clip.at("id")] = clip["sensor"]["preset"];
    dataset.kelvin_per_count = record.at("kelvin_per_count");
    for (const Json& clip : record.at("clips")) {
      dataset.clips.push_back(clip.at("id"));
      if (clip.at("status") == "done") dataset.made.push_back(dataset.clips.back());
    }
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("{}: not a dataset's record: {}", file.string(), error.what()));
  }
  if (!(dataset.kelvin_per_count > 0))
    throw DataError(fault(file.string() + ": kelvin_per_count", fmt::format("{}", dataset.kelvin_per_count),
                          "K", "more than 0"));
  return dataset;
}

const std::string& FilmedDataset::camera_of(const std::string& clip) const {
  const auto own = own_cameras.find(clip);
  return own == own_cameras.end() ? camera : own->second;
}

void FilmedDataset::check_clips(const std::vector<std::string>& ids) const {
  for (const std::string& id : ids) {
    if (std::ranges::find(clips, id) == clips.end())
      throw ConfigError(fault("--clips", fmt::format("\"{}\"", id), "",
                              fmt::format("a clip of {}: {}", layout.root.string(), list_names(clips))) +
                        did_you_mean(id, clips));
    if (std::ranges::find(made, id) == made.end())
      throw DataError(fmt::format("{}: clip {} is not made", layout.root.string(), id));
  }
}

ClipFilm read_clip_film(const FilmedDataset& dataset, const std::string& id, bool labels) {
  ClipFilm film;
  film.folder = dataset.layout.clip(id);
  film.id = id;
  film.frame_rate_hz = read_clip_record(film.folder / "clip.json").frame_rate_hz;
  if (!(film.frame_rate_hz > 0))
    throw DataError(fault((film.folder / "clip.json").string() + ": frame_rate_hz",
                          fmt::format("{}", film.frame_rate_hz), "Hz", "more than 0"));
  read_frames(film);
  const PictureSize size =
      read_picture_size(film.folder / "ir8" / frame_name(film.frames.front().frame_index));
  film.width_px = size.width_px;
  film.height_px = size.height_px;
  if (labels) read_labels_of(film);
  return film;
}

Plane<std::uint8_t> ClipFilm::read_levels(std::size_t frame) const {
  const Path file = folder / "ir8" / frame_name(frames[frame].frame_index);
  Plane<std::uint8_t> levels = read_png8(file);
  check_size(levels, *this, file);
  if (black_hot) {
    for (std::uint8_t& level : levels.pixels()) level = static_cast<std::uint8_t>(255 - level);
  }
  return levels;
}

Plane<std::uint16_t> ClipFilm::read_counts(std::size_t frame) const {
  const Path file = folder / "ir16" / frame_name(frames[frame].frame_index);
  Plane<std::uint16_t> counts = read_png16(file);
  check_size(counts, *this, file);
  return counts;
}

namespace {

ClipSource clip_of_folder(const Path& path, const std::vector<std::string>& ids) {
  const Path folder = std::filesystem::canonical(path);
  ClipSource source{.dataset = read_filmed_dataset(folder.parent_path().parent_path()),
                    .clips = {folder.filename().string()},
                    .chosen = true};
  if (!ids.empty())
    throw ConfigError(
        fault("--clips", list_names(ids), "", fmt::format("none, because {} is one clip", path.string())));
  source.dataset.check_clips(source.clips);
  return source;
}

}  // namespace

std::vector<std::string> ClipSource::not_made() const {
  std::vector<std::string> ids;
  if (!chosen)
    std::ranges::copy_if(dataset.clips, std::back_inserter(ids), [this](const std::string& id) {
      return std::ranges::find(dataset.made, id) == dataset.made.end();
    });
  return ids;
}

ClipSource find_clip_source(const Path& path, const std::vector<std::string>& ids) {
  if (!Layout{path}.is_begun() && std::filesystem::exists(path / "clip.json"))
    return clip_of_folder(path, ids);
  ClipSource source{.dataset = read_filmed_dataset(path), .clips = ids, .chosen = !ids.empty()};
  source.dataset.check_clips(ids);
  if (!source.chosen) source.clips = source.dataset.made;
  if (source.clips.empty())
    throw DataError(fmt::format("{}: none of {} clips is made; expected at least one", path.string(),
                                source.dataset.clips.size()));
  return source;
}

}  // namespace thermal
