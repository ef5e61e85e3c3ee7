#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "labels/label_set.h"

namespace thermal {

/// Classes over which a data set is balanced: small, medium and large animals, then the same of poachers (people).
inline constexpr std::size_t kBalanceClasses = 6;

/// One number per class.
using ClassCounts = std::array<std::int64_t, kBalanceClasses>;

/// "small_animal" … "large_poacher", in the order of ClassCounts.
[[nodiscard]] const std::array<std::string, kBalanceClasses>& balance_class_names();

/// Frames of a video with the same number of labels of each class.
struct FrameType {
  ClassCounts labels{};
  std::vector<int> frames;  ///< indices in the video, from 0, ascending
};

/// A video, with its frames counted by type.
struct BalanceVideo {
  std::string name;
  std::vector<FrameType> types;  ///< each with at least one label, no two alike, in the order of their counts
  std::size_t unlabelled = 0;    ///< frames without a label of any class; they have no type

  /// Labels of each class in all its frames.
  [[nodiscard]] ClassCounts available() const noexcept;
};

/// The frame types of each video, in the order of set.videos. Ignored labels, crowds and vehicles belong to no class
/// and are not counted; their frames may still be selected for other labels.
[[nodiscard]] std::vector<BalanceVideo> frame_types(const LabelSet& set);

}  // namespace thermal
