#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>

#include "dataset/exports/outlines.h"
#include "io/json/file.h"
#include "labels/label_set.h"

namespace thermal {

/// How well outlines reproduce masks: intersection over union, by size class.
class OutlineFigures {
 public:
  /// Intersection over union of outlines with masks, over targets.
  struct Figures {
    int targets = 0;
    double sum = 0;
    double least = 1;

    [[nodiscard]] double mean() const { return targets > 0 ? sum / targets : 1; }
  };

  void add(SizeClass size, double iou);

  [[nodiscard]] const Figures& of(SizeClass size) const { return figures_[static_cast<std::size_t>(size)]; }

  /// {"small": {"targets": 3, "mean": 1.0, "least": 1.0}, …} of the classes that there are.
  [[nodiscard]] Json json() const;

 private:
  std::array<Figures, 3> figures_{};
};

/// The mask of an annotation of COCO, cut to its box of pixels with a border of 1 px.
/// DataError with the annotation's id unless its `segmentation` is run lengths of a mask that is not empty, of a picture of at
/// most 64 million pixels.
[[nodiscard]] TargetMask mask_of(const Json& annotation);

/// Turns masks into outlines while a file of COCO is read.
class SegmentMaker {
 public:
  explicit SegmentMaker(const LabelSet& set);

  /// `segmentation` as COCO has polygons: a list of x, y, x, y, … for each part (edge_outlines()). Crowds, which have run
  /// lengths always, and what is polygons already, stay as they are.
  [[nodiscard]] Json polygons_of(const Json& annotation);

  /// The single outline of an annotation (filled_outline()).
  [[nodiscard]] Outline outline_of(const Json& annotation);

  [[nodiscard]] const OutlineFigures& figures() const noexcept { return figures_; }

 private:
  void count(const Json& annotation, double iou);

  std::unordered_map<std::int64_t, SizeClass> sizes_;  ///< by the label's id
  OutlineFigures figures_;
};

}  // namespace thermal
