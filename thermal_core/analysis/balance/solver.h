#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace thermal {

/// No bound.
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// minimise cost . x with lower <= x <= upper, some of x whole, and lower <= A x <= upper.
struct IntegerProgram {
  /// A variable, its bounds and its cost.
  struct Column {
    double lower = 0;
    double upper = kUnbounded;
    double cost = 0;
    bool whole = false;
  };
  /// A variable times a factor.
  struct Term {
    std::size_t column = 0;
    double factor = 0;
  };
  /// A sum of terms, and its bounds.
  struct Row {
    double lower = -kUnbounded;
    double upper = kUnbounded;
    std::vector<Term> terms;  ///< each column at most once
  };
  std::vector<Column> columns;
  std::vector<Row> rows;

  /// Returns the column's index.
  std::size_t add(const Column& column) {
    columns.push_back(column);
    return columns.size() - 1;
  }
};

/// When a search ends.
struct SolverLimits {
  double gap = 0;         ///< largest accepted (objective - bound) / |objective|
  double time_s = 60;     ///< wall clock
  int nodes = 100000000;  ///< of the search tree
};

/// How a search ended.
enum class SolverEnd {
  solved,      ///< to within the gap
  stopped,     ///< stopped at a limit, with a solution
  infeasible,  ///< proven
  nothing,     ///< stopped at a limit without a solution
};

/// Result of a search.
struct SolverResult {
  SolverEnd end = SolverEnd::nothing;
  std::vector<double> values;  ///< one per column; empty without a solution. Whole ones to within 1e-6
  double objective = 0;
  double bound = -kUnbounded;  ///< proven lower bound
};

/// Solves with COIN-OR CBC: one thread and a fixed seed, so that the same program gives the same solution unless the
/// time limit ends the search. Prints nothing.
[[nodiscard]] SolverResult solve(const IntegerProgram& program, const SolverLimits& limits);

}  // namespace thermal
