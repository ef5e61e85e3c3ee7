#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/json/file.h"

namespace thermal {

/// A key of a config that is fitted.
struct FittedKey {
  const char* stage = "";  ///< stage of the chain whose keys are searched together
  const char* path = "";   ///< "/sensor/noise/amount"
  double low = 0;          ///< search range
  double high = 1;
  bool by_ratio = false;  ///< distances are ratios
  bool varies = true;     ///< from clip to clip: a uniform distribution; otherwise one value
  bool is_whole = false;  ///< a whole number
  bool is_share = false;  ///< the share of clips that have a stage
};

/// The nearest number of three digits.
[[nodiscard]] double rounded_to_three(double value);

/// All keys, stage by stage, in the order of the search: the most visible first.
[[nodiscard]] const std::vector<FittedKey>& fitted_keys();

/// Points of the search space: for each key, its minimum and maximum, or its single value, scaled from 0 to 1 of the
/// key's range.
class FittedSpace {
 public:
  /// `document`: the user's config; `resolved`: the same with presets and defaults.
  FittedSpace(Json document, const Json& resolved);

  [[nodiscard]] std::size_t size() const noexcept { return start_.size(); }

  /// The config's own point, clamped to the keys' ranges.
  [[nodiscard]] const std::vector<double>& start() const noexcept { return start_; }

  /// Indices of the coordinates of each stage.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& stages() const noexcept { return stages_; }

  /// Indices of the coordinates that are shares of the clips.
  [[nodiscard]] const std::vector<std::size_t>& shares() const noexcept { return shares_; }

  /// The config with the values of a point where it differs from the start, rounded to three digits. A key within a
  /// choice is set in each of its entries that are objects. Coordinates are clamped to 0 to 1.
  [[nodiscard]] Json document_at(const std::vector<double>& point) const;

  /// A key's value at a point, as document_at() writes it: a number or a distribution.
  [[nodiscard]] Json value_at(std::size_t number, const std::vector<double>& point) const;

 private:
  [[nodiscard]] double number_at(const FittedKey& key, double coordinate) const;

  [[nodiscard]] bool is_at_start(std::size_t number, const std::vector<double>& point) const;

  Json document_;
  std::vector<double> start_;
  std::vector<std::size_t> first_;  ///< coordinate of each key
  std::vector<bool> known_;         ///< by key: whether the config has its stage
  std::vector<std::vector<std::size_t>> stages_;
  std::vector<std::size_t> shares_;
};

}  // namespace thermal
