#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/json/file.h"

namespace thermal {

/// A key of a config that is fitted.
struct FittedKey {
  const char* stage = "";  ///< of the chain: keys of a stage are searched together
  const char* path = "";   ///< "/sensor/noise/amount"
  double low = 0;          ///< what is searched
  double high = 1;
  bool by_ratio = false;  ///< distances are ratios
  bool varies = true;     ///< from clip to clip: a uniform distribution; otherwise one value
  bool is_whole = false;  ///< a whole number
  bool is_share = false;  ///< a stage that some clips have: the share of the clips
};

/// The nearest number of three digits.
[[nodiscard]] double rounded_to_three(double value);

/// All of them, stage by stage, in the order in which they are searched: what is seen most clearly first.
[[nodiscard]] const std::vector<FittedKey>& fitted_keys();

/// Places in the space that is searched: for each key, its lowest and highest value, or its one value, from 0 to 1 of
/// the key's range.
class FittedSpace {
 public:
  /// `document`: a config as the user has it; `resolved`: the same after its presets and defaults.
  FittedSpace(Json document, const Json& resolved);

  [[nodiscard]] std::size_t size() const noexcept { return start_.size(); }

  /// Where the config is itself; what is beyond a key's range, at its end.
  [[nodiscard]] const std::vector<double>& start() const noexcept { return start_; }

  /// Numbers of the coordinates of each stage.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& stages() const noexcept { return stages_; }

  /// Numbers of the coordinates that are shares of the clips.
  [[nodiscard]] const std::vector<std::size_t>& shares() const noexcept { return shares_; }

  /// The config with the values of a place where it differs from the start, rounded to three digits. A key within a choice is
  /// set in each of its entries that are objects. What lies outside of 0 to 1 counts as its end.
  [[nodiscard]] Json document_at(const std::vector<double>& place) const;

  /// A key's value at a place, as document_at() writes it: a number or a distribution.
  [[nodiscard]] Json value_at(std::size_t number, const std::vector<double>& place) const;

 private:
  [[nodiscard]] double number_at(const FittedKey& key, double coordinate) const;

  [[nodiscard]] bool is_at_start(std::size_t number, const std::vector<double>& place) const;

  Json document_;
  std::vector<double> start_;
  std::vector<std::size_t> first_;  ///< coordinate of each key
  std::vector<bool> known_;         ///< by key: not of a stage that the config lacks
  std::vector<std::vector<std::size_t>> stages_;
  std::vector<std::size_t> shares_;
};

}  // namespace thermal
