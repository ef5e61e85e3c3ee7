#include "dataset/exports/tiff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "dataset/clip_files.h"
#include "dataset/dataset_file.h"
#include "dataset/exports/coco.h"
#include "dataset/exports/picture_tags.h"
#include "dataset/label_source.h"
#include "io/image/png.h"

namespace thermal {
namespace {

constexpr double kMostLatitudeDeg = 89;  // east is undefined at a pole
constexpr double kOriginLongitudeDeg = 23;
constexpr double kOriginLatitudeDeg = -19;
constexpr double kOriginHeightM = 900;

/// "winter", or "train/winter" with splits.
std::string folder_of(const ExportInput& input, std::size_t video) {
  const std::string clip = file_name_of(input.set.videos[video].name);
  return input.split_asked ? input.splits[input.of_video[video]] + "/" + clip : clip;
}

/// Each clip as a separate split, for their COCO files, with the names of exported pictures.
ExportInput by_clip(const ExportInput& input) {
  ExportInput clips;
  clips.boxes_changed = input.boxes_changed;
  clips.set.images = input.set.images;
  if (input.boxes_changed) clips.set.labels = input.set.labels;
  clips.of_video.resize(input.set.videos.size());
  for (std::size_t video = 0; video < input.set.videos.size(); ++video) {
    clips.splits.push_back(folder_of(input, video));
    clips.of_video[video] = video;
  }
  for (LabelImage& image : clips.set.images) image.file = "images/" + flat_name(input.set, image) + ".tif";
  return clips;
}

/// Poses of a clip by frame. DataError with the line unless all lines are frames.
std::map<int, FramePose> poses_in(const Path& file) {
  std::map<int, FramePose> poses;
  check_is_no_link(file);
  for_frame_lines(file, [&poses](const Json& frame) {
    FramePose& pose = poses[frame.at("frame_index").get<int>()];
    pose.time_s = frame.at("time_s").get<double>();
    if (frame.contains("camera_to_world"))
      pose.camera_to_world = frame["camera_to_world"].get<std::array<double, 16>>();
  });
  return poses;
}

/// Intrinsics of each clip of a dataset's labels.
std::map<std::string, Json> intrinsics_in(const std::string& coco) {
  std::map<std::string, Json> found;
  (void)parse_json_elements(coco, "annotations.json",
                            [&](const std::string& list, std::size_t, const Json& element) {
                              if (list == "videos" && element.contains("camera"))
                                found[element.value("name", "")] = element["camera"];
                            });
  return found;
}

/// Reads from a dataset's record. DataError with the file for a value of another type.
template <typename Read>
auto from_record(const Path& dataset, const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw DataError(
        fmt::format("{}: not a dataset's record: {}", Layout{dataset}.dataset_json().string(), error.what()));
  }
}

/// A clip being written: the shared properties of its pictures.
struct TaggedClip {
  std::string name;
  TaggedCamera camera;
  std::map<int, FramePose> poses;
};

class TiffPictures {
 public:
  TiffPictures(const ExportInput& input, const ExportOptions& options, const GeoPosition& origin,
               const std::string& coco)
      : set_(input.set),
        type_(options.tiff_type.value_or(TiffType::float32)),
        dataset_(options.source),
        record_(read_dataset_file(dataset_)),
        kelvin_per_count_(
            from_record(dataset_, [this] { return record_.at("kelvin_per_count").get<double>(); })),
        georeference_(origin),
        intrinsics_(intrinsics_in(coco)) {}

  [[nodiscard]] TaggedClip clip_of(const LabelImage& image) const {
    const std::string& name = set_.videos[image.video].name;
    const auto intrinsics = intrinsics_.find(name);
    const Json camera = intrinsics == intrinsics_.end() ? Json() : intrinsics->second;
    return {
        .name = name,
        .camera = from_record(dataset_, [&] { return tagged_camera(record_.at("config"), name, camera); }),
        .poses = poses_in(picture_of(set_, image).parent_path().parent_path() / "frames.jsonl")};
  }

  /// The bytes of a picture's TIFF.
  [[nodiscard]] std::string encoded(const LabelImage& image, const TaggedClip& clip) const {
    const Path file = picture_of(set_, image);
    const Plane<std::uint16_t> counts = read_png16(file);
    const auto pose = clip.poses.find(image.frame_index);
    const TiffTags tags = picture_tags(clip.camera, pose == clip.poses.end() ? FramePose() : pose->second,
                                       georeference_, type_, kelvin_per_count_);
    return type_ == TiffType::uint16 ? encode_tiff(counts, tags) : encode_tiff(kelvin_of(counts), tags);
  }

 private:
  [[nodiscard]] Plane<float> kelvin_of(const Plane<std::uint16_t>& counts) const {
    Plane<float> kelvin(counts.width_px(), counts.height_px());
    std::ranges::transform(counts.pixels(), kelvin.pixels().begin(), [this](std::uint16_t count) {
      return static_cast<float>(count * kelvin_per_count_);
    });
    return kelvin;
  }

  const LabelSet& set_;
  TiffType type_;
  Path dataset_;
  Json record_;
  double kelvin_per_count_;
  Georeference georeference_;
  std::map<std::string, Json> intrinsics_;
};

bool has_pose(const TaggedClip& clip, const LabelImage& image) {
  const auto pose = clip.poses.find(image.frame_index);
  return pose != clip.poses.end() && pose->second.camera_to_world.has_value();
}

}  // namespace

ExportPlan plan_tiff(const ExportInput& input, const std::string& coco, const std::string& name) {
  const ExportInput clips = by_clip(input);
  ExportPlan plan;
  std::vector<bool> has_pictures(clips.splits.size(), false);
  for (std::size_t i = 0; i < clips.set.images.size(); ++i) {
    const LabelImage& image = clips.set.images[i];
    plan.pictures.push_back({.image = i, .to = clips.splits[image.video] + "/" + image.file});
    has_pictures[image.video] = true;
  }
  std::vector<std::string> files = split_coco(clips, coco, name);
  for (std::size_t video = 0; video < files.size(); ++video)
    if (has_pictures[video])
      plan.texts.push_back(
          {.to = clips.splits[video] + "/annotations.json", .content = std::move(files[video])});
  return plan;
}

GeoPosition default_origin(const Path& dataset) {
  return from_record(dataset, [&] {
    const Json weather = read_dataset_file(dataset).at("config").value("weather", Json::object());
    return GeoPosition{.latitude_deg = std::clamp(weather.value("latitude_deg", kOriginLatitudeDeg),
                                                  -kMostLatitudeDeg, kMostLatitudeDeg),
                       .longitude_deg = kOriginLongitudeDeg,
                       .height_m = weather.value("elevation_m", kOriginHeightM)};
  });
}

GeoPosition parse_origin(const std::string& text, double default_height_m) {
  constexpr double kMostLongitudeDeg = 180;
  constexpr double kLeastHeightM = -500;
  constexpr double kMostHeightM = 9000;
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ','))
    if (const auto number = number_in<double>(part)) numbers.push_back(*number);
  const bool complete =
      numbers.size() == split(text, ',').size() && (numbers.size() == 2 || numbers.size() == 3);
  if (complete && numbers.size() == 2) numbers.push_back(default_height_m);
  if (!complete || !(std::abs(numbers[0]) <= kMostLatitudeDeg) ||
      !(std::abs(numbers[1]) <= kMostLongitudeDeg) ||
      !(numbers[2] >= kLeastHeightM && numbers[2] <= kMostHeightM))
    throw ConfigError(fault("--origin", text, "",
                            "LAT,LON or LAT,LON,HEIGHT: -89 to 89 deg, -180 to 180 deg, -500 to 9000 m, e.g. "
                            "-19.3,23.1"));
  return {.latitude_deg = numbers[0], .longitude_deg = numbers[1], .height_m = numbers[2]};
}

int write_tiffs(const ExportPlan& plan, const ExportInput& input, const ExportOptions& options,
                const GeoPosition& origin, const std::string& coco, const ExportFolder& folder,
                const RunHooks& hooks) {
  constexpr std::size_t kAtOnce = 32;
  const LabelSet& set = input.set;
  const TiffPictures pictures(input, options, origin, coco);
  Progress progress{.clip = "", .done = 0, .total = static_cast<int>(plan.pictures.size())};
  std::optional<TaggedClip> clip;
  int without_pose = 0;
  for (std::size_t begin = 0; begin < plan.pictures.size();) {
    if (hooks.stop_wanted()) throw Cancelled();
    const LabelImage& first = set.images[plan.pictures[begin].image];
    if (!clip || clip->name != set.videos[first.video].name) {
      clip = pictures.clip_of(first);
      make_folder((folder.path() / plan.pictures[begin].to).parent_path());
    }
    std::size_t end = begin;
    while (end < plan.pictures.size() && end - begin < kAtOnce &&
           set.images[plan.pictures[end].image].video == first.video)
      ++end;
    parallel_for(end - begin, 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = begin + from; k < begin + to; ++k) {
        const PlannedPicture& picture = plan.pictures[k];
        const std::string bytes = pictures.encoded(set.images[picture.image], *clip);
        write_file(folder.path() / picture.to, std::as_bytes(std::span(bytes)));
      }
    });
    for (; begin < end; ++begin)
      without_pose += has_pose(*clip, set.images[plan.pictures[begin].image]) ? 0 : 1;
    progress.clip = clip->name;
    progress.done = static_cast<int>(end);
    hooks.report(progress);
  }
  return without_pose;
}

}  // namespace thermal
