#pragma once

#include "analysis/compare/comparison.h"

namespace veldt {

/// Prints what was read, one row per measure, how well a classifier separates them, and tables of targets.
void print_tables(const thermal::Comparison& comparison);

}  // namespace veldt
