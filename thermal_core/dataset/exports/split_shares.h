#pragma once

#include <string>
#include <vector>

namespace thermal {

/// A part of a dataset: its name, and its fraction of all labels and pictures.
struct SplitShare {
  std::string name;
  double share = 0;  ///< above 0; those of all splits add up to 1
};

/// Parses "train:0.8,val:0.2". ConfigError "--split = …; expected …" unless names are unique words and shares are
/// above 0 and add up to 1 within 0.001, which allows for rounded thirds.
[[nodiscard]] std::vector<SplitShare> parse_splits(const std::string& text);

}  // namespace thermal
