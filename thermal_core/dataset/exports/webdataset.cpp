#include "dataset/exports/webdataset.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "dataset/exports/coco.h"
#include "dataset/label_source.h"
#include "io/json/entry.h"
#include "io/json/file.h"
#include "io/system/tar_file.h"

namespace thermal {
namespace {

/// "winter_000012": a name up to its first dot; files with one key are one sample.
std::string key_of(const LabelSet& set, const LabelImage& image) {
  std::string key = flat_name(set, image);
  std::ranges::replace(key, '.', '_');
  return key;
}

void check_ending(const LabelImage& image) {
  const std::string ending = ending_of(image.file);
  if (ending.size() > 1 && ending != ".json") return;
  throw DataError(fault(fmt::format("file_name of image {}", id_text(image.id)),
                        fmt::format("\"{}\"", image.file), "",
                        "the extension of a picture, such as .png, as --format webdataset requires"));
}

/// Adjacent samples with one key would be merged.
void check_keys(const LabelSet& set) {
  std::map<std::string, std::size_t> images;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    const LabelImage& image = set.images[i];
    check_ending(image);
    const std::string key = key_of(set, image);
    const std::string name = key + ending_of(image.file);
    if (!RelativeName::part_of(name))
      throw DataError(fault(fmt::format("\"{}\": name of its file", image.file), fmt::format("\"{}\"", name),
                            "", RelativeName::kPartRule));
    const auto [there, fresh] = images.emplace(key, i);
    if (!fresh)
      throw DataError(fmt::format("\"{}\" and \"{}\" would both become {}; expected names that differ",
                                  set.images[there->second].file, image.file, name));
  }
}

Json annotation_of_sample(const LabelSet& set, const Label& label) {
  const LabelCategory& category = set.categories[label.category];
  Json json = {{"id", json_of(label.id)},
               {"category", category.name},
               {"category_id", json_of(category.id)},
               {"bbox", bbox_of(label.box)},
               {"area", label.area_px},
               {"iscrowd", label.crowd ? 1 : 0},
               {"ignore", label.ignore},
               {"noisy", label.noisy},
               {"truncated", label.truncated},
               {"size_class", size_class_name(label.size)}};
  if (label.track_id) json["track_id"] = *label.track_id;
  if (label.occluded) json["occluded"] = *label.occluded;
  if (label.visibility) json["visibility"] = *label.visibility;
  return json;
}

}  // namespace

ExportPlan plan_webdataset(const ExportInput& input, std::size_t samples) {
  const LabelSet& set = input.set;
  check_keys(set);
  std::vector<std::vector<std::vector<std::size_t>>> shards(input.splits.size());  // by split: images
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    auto& of_split = shards[input.of_video[set.images[i].video]];
    if (of_split.empty() || of_split.back().size() == samples) of_split.emplace_back();
    of_split.back().push_back(i);
  }
  ExportPlan plan;
  for (std::size_t split = 0; split < shards.size(); ++split)
    for (std::size_t k = 0; k < shards[split].size(); ++k)
      plan.shards.push_back(
          {.to = fmt::format("{}/{}-{:06}.tar", input.splits[split], file_name_of(set.name), k),
           .images = std::move(shards[split][k])});
  return plan;
}

std::string sample_json(const LabelSet& set, std::size_t image, const std::vector<std::size_t>& first) {
  const LabelImage& of = set.images[image];
  const LabelVideo& video = set.videos[of.video];
  Json json = {{"clip", video.name},
               {"frame_index", of.frame_index},
               {"width", of.width_px},
               {"height", of.height_px}};
  if (of.time_s) json["time_s"] = *of.time_s;
  if (video.frame_rate_hz > 0) json["frame_rate_hz"] = video.frame_rate_hz;
  Json annotations = Json::array();
  for (std::size_t k = first[image]; k < first[image + 1]; ++k)
    annotations.push_back(annotation_of_sample(set, set.labels[k]));
  json["annotations"] = std::move(annotations);
  return json.dump() + "\n";
}

void write_shard(const Path& file, const PlannedShard& shard, const LabelSet& set,
                 const std::vector<std::size_t>& first,
                 const std::function<void(const LabelImage& image)>& begin_sample) {
  TarFile tar(file);
  for (const std::size_t i : shard.images) {
    const LabelImage& image = set.images[i];
    begin_sample(image);
    const std::string key = key_of(set, image);
    tar.add(key + ".json", sample_json(set, i, first));
    tar.add(key + ending_of(image.file), read_file(picture_of(set, image)));
  }
  tar.close();
}

bool is_shard_name(const Path& name, const ExportInput& input) {
  const std::string file = name.filename().string();
  return std::ranges::find(input.splits, name.parent_path().string()) != input.splits.end() &&
         file.starts_with(file_name_of(input.set.name) + "-") && file.ends_with(".tar");
}

}  // namespace thermal
