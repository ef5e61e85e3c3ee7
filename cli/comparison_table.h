#pragma once

#include "analysis/compare/comparison.h"

namespace veldt {

/// Prints the sources, one row per measure, the separability by a classifier, and tables of targets.
void print_tables(const thermal::Comparison& comparison);

}  // namespace veldt
