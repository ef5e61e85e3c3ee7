#pragma once

#include <vector>

#include "analysis/selection.h"
#include "cli/command.h"

namespace veldt {

/// What `balance` did.
struct Balanced {
  std::vector<thermal::LabelSource> sources;
  thermal::BalanceProgram program;
  thermal::BalanceResult result;
  thermal::Selection selection;
  double time_s = 0;
};

/// Prints labels taken out of those available, by video and class, and how good the selection is.
void print_table(const Balanced& balanced);

/// The same as JSON.
[[nodiscard]] thermal::Json to_json(const Balanced& balanced);

}  // namespace veldt
