#pragma once

#include <array>
#include <vector>

#include "analysis/evaluate.h"

namespace veldt {

inline constexpr std::array kSizes = {thermal::SizeClass::small, thermal::SizeClass::medium,
                                      thermal::SizeClass::large};

/// The columns of a row: each of kSizes, then all.
[[nodiscard]] std::vector<thermal::Counts> columns_of(const thermal::SizeCounts& counts);

/// Prints the sources, then precision and recall and the counts behind them by clip and by category, each in columns of
/// size classes, then average precision. Undefined values are "-".
void print_tables(const thermal::Evaluation& evaluation, const thermal::LabelSet& truth,
                  std::size_t detections, const thermal::EvaluateOptions& options);

}  // namespace veldt
