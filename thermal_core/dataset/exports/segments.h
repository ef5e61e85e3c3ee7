#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>

#include "dataset/exports/outlines.h"
#include "dataset/exports/plan.h"
#include "io/json/file.h"
#include "labels/label_set.h"

namespace thermal {

/// Accuracy of outlines against masks: intersection over union, by size class.
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

  /// {"small": {"targets": 3, "mean": 1.0, "least": 1.0}, …} for the classes that occur.
  [[nodiscard]] Json json() const;

 private:
  std::array<Figures, 3> figures_{};
};

/// The mask of a COCO annotation, clipped to its box with a border of 1 px. DataError with the annotation's id unless
/// its `segmentation` is run lengths of a non-empty mask, of a picture of at most 64 million pixels.
[[nodiscard]] TargetMask mask_of(const Json& annotation);

/// Converts masks to the wanted kind while a COCO file is read. `segmentation` is read as run lengths, {"size",
/// "counts"} with compressed counts or a list, or as polygons, lists of x, y, x, y, … of three corners or more, all
/// within 1e8 px. DataError "annotation 3: segmentation = …; expected …" for anything else, and for none.
class SegmentMaker {
 public:
  /// @param set  its pictures have sizes
  SegmentMaker(const LabelSet& set, Segmentation wanted);

  /// `segmentation` as wanted. Polygons are lists of x, y, x, y, … for each part (edge_outlines()); crowds, which have
  /// run lengths always, keep them. Run lengths are those of mask_of_polygons(). Segmentations of the wanted kind are
  /// unchanged.
  [[nodiscard]] Json segmentation_of(const Json& annotation);

  /// The single outline of an annotation: filled_outline() of run lengths, joined_outline() of polygons.
  [[nodiscard]] Outline outline_of(const Json& annotation);

  /// Whether any `segmentation` was converted.
  [[nodiscard]] bool has_changed() const noexcept { return has_changed_; }

  [[nodiscard]] const OutlineFigures& figures() const noexcept { return figures_; }

 private:
  struct Target {
    SizeClass size = SizeClass::medium;
    bool crowd = false;
    int width_px = 0;  ///< of its picture
    int height_px = 0;
  };

  [[nodiscard]] const Target& target_of(const Json& annotation) const;
  [[nodiscard]] Json polygons_of(const Json& annotation);
  [[nodiscard]] Json run_lengths_of(const Json& annotation) const;

  Segmentation wanted_;
  std::unordered_map<LabelId, Target> targets_;  ///< by the label's id
  bool has_changed_ = false;
  OutlineFigures figures_;
};

}  // namespace thermal
