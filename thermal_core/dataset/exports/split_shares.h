#pragma once

#include <string>
#include <vector>

namespace thermal {

/// A part of a dataset: its name, and how much of all labels and pictures it is to have.
struct SplitShare {
  std::string name;
  double share = 0;  ///< above 0; those of all splits add up to 1
};

/// Of "train:0.8,val:0.2". ConfigError "--split = …; expected …" unless names are words that come once and shares
/// are above 0 and add up to 1 within 0.001, so that three thirds can be written down.
[[nodiscard]] std::vector<SplitShare> parse_splits(const std::string& text);

}  // namespace thermal
