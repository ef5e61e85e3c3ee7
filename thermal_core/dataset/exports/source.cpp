#include "dataset/exports/source.h"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "dataset/dataset_file.h"
#include "dataset/exports/coco.h"
#include "dataset/exports/splits.h"
#include "dataset/label_source.h"
#include "io/image/pictures.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

using Frames = std::map<std::pair<std::size_t, int>, std::size_t>;  // image by video and frame index

Frames frames_of(const LabelSet& set) {
  Frames frames;
  for (std::size_t i = 0; i < set.images.size(); ++i)
    frames.emplace(std::pair(set.images[i].video, set.images[i].frame_index), i);
  return frames;
}

std::size_t find_video(const LabelSet& set, const std::string& name, const Path& file) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < set.videos.size(); ++i) {
    if (set.videos[i].name == name) return i;
    names.push_back(set.videos[i].name);
  }
  throw DataError(fmt::format("{}: video \"{}\" is not in {}; expected one of {}{}", file.string(), name,
                              set.name, list_names(names), did_you_mean(name, names)));
}

std::vector<bool> taken_images(const LabelSet& set, const SelectedDataset& selected, const Path& file) {
  const Frames frames = frames_of(set);
  std::vector<bool> taken(set.images.size(), false);
  for (const SelectedVideo& video : selected.videos) {
    const std::size_t place = find_video(set, video.name, file);
    for (const int frame : video.frames) {
      const auto image = frames.find({place, frame});
      if (image == frames.end())
        throw DataError(
            fmt::format("{}: video \"{}\" of {} has no frame {}; expected a frame_index of its pictures",
                        file.string(), video.name, set.name, frame));
      taken[image->second] = true;
    }
  }
  return taken;
}

}  // namespace

LabelSet take_selected(const LabelSet& set, const SelectedDataset& selected, const Path& file) {
  const std::vector<bool> taken = taken_images(set, selected, file);
  LabelSet result = set;
  result.images.clear();
  result.labels.clear();
  std::vector<std::size_t> places(set.images.size(), 0);
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    if (!taken[i]) continue;
    places[i] = result.images.size();
    result.images.push_back(set.images[i]);
  }
  for (const Label& label : set.labels) {
    if (!taken[label.image]) continue;
    result.labels.push_back(label);
    result.labels.back().image = places[label.image];
  }
  if (result.images.empty())
    throw DataError(fmt::format("{}: no frame of {}; expected at least one", file.string(), set.name));
  return result;
}

namespace {

bool is_ours(const Path& source) { return Layout{source}.is_begun(); }

/// The COCO file of a source; empty if there is none.
Path coco_file_of(const Path& source) {
  if (is_ours(source)) return Layout{source}.annotations_json();
  return std::filesystem::is_regular_file(source) ? source : Path();
}

/// COCO files are often in annotations/ beside the folders of pictures; file names are then relative to the parent of
/// both.
Path root_of(const LabelSet& set) {
  Path root = Path(set.root);
  if (set.images.empty() || root.filename() != "annotations") return root;
  const bool beside = !std::filesystem::exists(root / set.images.front().file) &&
                      std::filesystem::exists(root.parent_path() / set.images.front().file);
  return beside ? root.parent_path() : root;
}

/// Labels of the requested pictures: all, or the selected ones.
LabelSet read_set(const ExportOptions& options) {
  LabelSet set = read_labels(options.source, options.unfinished_too);
  if (!options.selection.empty()) {
    const Selection selection = read_selection(options.selection);
    set = take_selected(set, selection_for(selection, options.selection, options.source, set.name),
                        options.selection);
  }
  if (set.images.empty())
    throw DataError(fmt::format("{} has no pictures; expected at least one", options.source.string()));
  set.root = root_of(set).string();
  return set;
}

void use_ir16(LabelSet& set, const Path& source, ExportFormat format) {
  if (!is_ours(source) && format == ExportFormat::tiff)
    throw ConfigError(fault("--format", "tiff", "", "another; only Veldt datasets have temperatures"));
  if (!is_ours(source))
    throw ConfigError(fault("--images", "ir16", "", "ir8; only Veldt datasets have 16-bit pictures"));
  for (LabelImage& image : set.images) image.file = ir16_file(image.file);
}

/// Names or links that lead out of the folder could add any file of this machine to an export that is published.
void check_pictures(const LabelSet& set) {
  std::vector<std::string> missing;
  for (const LabelImage& image : set.images) {
    try {
      (void)picture_of(set, image);
    } catch (const IoError&) {
      if (std::filesystem::exists(Path(set.root) / image.file)) throw;
      missing.push_back(image.file);
    }
  }
  if (missing.empty()) return;
  constexpr std::size_t kMost = 3;
  throw DataError(fmt::format("{}: no picture {}; expected all {} that the labels refer to",
                              set.root.empty() ? "." : set.root, list_names(missing, kMost),
                              set.images.size()));
}

bool has_folders_of_splits(ExportFormat format) {
  return format != ExportFormat::coco && format != ExportFormat::birdsai && format != ExportFormat::tiff;
}

bool needs_sizes(const ExportOptions& options) {
  return has_folders_of_splits(options.format) || options.boxes == BoxStyle::drawn ||
         options.segmentation.has_value();
}

void find_sizes(LabelSet& set) {
  for (LabelImage& image : set.images) {
    if (image.width_px > 0 && image.height_px > 0) continue;
    const PictureSize size = read_picture_size(picture_of(set, image));
    image.width_px = size.width_px;
    image.height_px = size.height_px;
  }
}

std::uint32_t own_seed(const Path& source) {
  constexpr std::uint32_t kDefault = 1;
  return is_ours(source) ? read_dataset_file(source).at("config").value("seed", kDefault) : kDefault;
}

void share_out(ExportInput& input, const ExportOptions& options, std::uint32_t seed) {
  input.split_asked = !options.splits.empty();
  for (const SplitShare& split : options.splits) input.splits.push_back(split.name);
  if (input.split_asked) {
    input.of_video = split_videos(input.set, options.splits, seed);
    return;
  }
  input.splits = {has_folders_of_splits(options.format) ? "train" : "all"};
  input.of_video.resize(input.set.videos.size(), 0);
}

}  // namespace

ExportSource read_export_source(const ExportOptions& options) {
  ExportSource source;
  LabelSet& set = source.input.set;
  set = read_set(options);
  const bool tiff = options.format == ExportFormat::tiff;
  if (options.ir16 || tiff) use_ir16(set, options.source, options.format);
  check_pictures(set);
  if (needs_sizes(options)) find_sizes(set);
  const Path file = coco_file_of(options.source);
  if (options.format == ExportFormat::coco || tiff || options.segmentation || file.empty())
    source.coco = file.empty() ? coco_text(set) : read_file(file);
  source.has_foreign_masks = !is_ours(options.source);
  source.coco_name = file.empty() ? set.name : file.string();
  source.labels_sha256 = source.coco.empty() ? sha256_of_file(file) : sha256_of(source.coco);
  source.all = options.selection.empty() && options.splits.empty() && !options.ir16 && !set.from_windows &&
               options.boxes == BoxStyle::visible && options.segmentation != Segmentation::polygon;
  source.input.boxes_changed = options.boxes == BoxStyle::drawn;
  if (source.input.boxes_changed) widen_as_drawn(set, options.fills);
  source.seed = options.seed ? *options.seed : own_seed(options.source);
  share_out(source.input, options, source.seed);
  return source;
}

}  // namespace thermal
