#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/exports/splits.h"
#include "io/system/files.h"
#include "labels/box_style.h"
#include "labels/label_set.h"

namespace thermal {

/// Layout of an export: see DATASET.md.
enum class ExportFormat { coco, yolo, mot, birdsai, webdataset, tiff };

/// Masks of labels: run lengths, or outlines.
enum class Segmentation { rle, polygon };

/// Pixels of TIFFs: kelvin, or counts with their scale in tags.
enum class TiffType { float32, uint16 };

/// Options of an export.
struct ExportOptions {
  Path source;  ///< as read_labels() accepts it
  ExportFormat format = ExportFormat::coco;
  Path out;  ///< empty or not existing yet
  /// Method for pictures; empty: hard links. Not of webdataset, which copies them into tar files.
  std::optional<Linking> linking = {};
  BoxStyle boxes = BoxStyle::visible;
  std::optional<DrawnFills> fills = {};  ///< of drawn boxes; empty: drawn_margin_px()
  bool ir16 = false;                     ///< 16-bit pictures, which only Veldt datasets have
  std::vector<SplitShare> splits;        ///< empty: no split
  std::optional<std::uint32_t> seed;     ///< seed of the splits; empty: the dataset's own, or 1
  Path selection;                        ///< frames to export; empty: all
  bool unfinished_too = false;
  std::optional<int> samples_per_shard = {};  ///< of webdataset alone, 1 to 1,000,000; empty: 1000
  /// Of coco, by default rle; yolo supports polygon alone, by default boxes.
  std::optional<Segmentation> segmentation = {};
  std::optional<TiffType> tiff_type = {};  ///< of tiff alone; empty: float32
  std::string origin = {};  ///< of tiff alone, as parse_origin() reads it; empty: default_origin()
  Path scratch = {};  ///< of webdataset alone: tar files are built here, one at a time; empty: in OUT.part
};

/// Input of an export, and the split of each video.
struct ExportInput {
  LabelSet set;                       ///< its pictures have sizes, if the format needs them
  std::vector<std::string> splits;    ///< names; a single one without splits
  std::vector<std::size_t> of_video;  ///< for each video with pictures, its index into `splits`
  bool split_asked = false;
  bool boxes_changed = false;  ///< boxes of the set differ from those of its file
};

/// A picture that goes into an export.
struct PlannedPicture {
  std::size_t image = 0;  ///< index into the set's images
  std::string to;         ///< relative to the export's folder, "/" between folders
};

/// A text file of an export.
struct PlannedText {
  std::string to;
  std::string content;
  std::string of = {};  ///< the picture that it belongs to, for messages; empty: none
};

/// A tar file of pictures with their labels.
struct PlannedShard {
  std::string to;
  std::vector<std::size_t> images;  ///< indices into the set's images
};

/// All files of an export: pictures, with or without labels, single or in shards, and text files.
struct ExportPlan {
  std::vector<PlannedPicture> pictures;
  std::vector<PlannedShard> shards;
  std::vector<PlannedText> texts;
};

/// Where the labels of each image start; one more entry for the end.
[[nodiscard]] std::vector<std::size_t> first_labels(const LabelSet& set);

/// A name usable for one file or folder: "/" and "\" become "_".
[[nodiscard]] std::string file_name_of(std::string name);

/// ".png" of "a/b.png"; empty without an extension.
[[nodiscard]] std::string ending_of(const std::string& file);

/// DataError with the labels unless all have tracks, unique within a picture. `format` is the format that needs them.
void check_tracks(const LabelSet& set, std::string_view format);

/// DataError if the order of the pictures of an image's video is unknown. `format` is the format that needs it.
void check_in_time(const LabelSet& set, const LabelImage& image, std::string_view format);

/// DataError if a file would be written outside the export's folder, or over another one.
void check_targets(const ExportPlan& plan, const LabelSet& set);

}  // namespace thermal
