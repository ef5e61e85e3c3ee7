#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dataset/exports/split_shares.h"
#include "io/system/files.h"
#include "labels/box_style.h"

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

}  // namespace thermal
