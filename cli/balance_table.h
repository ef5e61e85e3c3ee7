#pragma once

#include <vector>

#include "analysis/selection.h"
#include "cli/command.h"

namespace veldt {

/// Result of `balance`.
struct Balanced {
  std::vector<thermal::LabelSource> sources;
  thermal::BalanceProgram program;
  thermal::BalanceResult result;
  thermal::Selection selection;
  double time_s = 0;
};

/// Prints selected and available labels by video and class, and the quality of the selection.
void print_table(const Balanced& balanced);

/// The same as JSON.
[[nodiscard]] thermal::Json to_json(const Balanced& balanced);

}  // namespace veldt
