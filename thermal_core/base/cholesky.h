#pragma once

#include <vector>

namespace thermal {

/// Solves A x = b for a symmetric, positive definite matrix, row by row in `a`, by Cholesky's method. Sums have one
/// order, so that a solution has the same bits on every processor, which no solver of a library promises.
[[nodiscard]] std::vector<double> solve_positive_definite(std::vector<double> a, std::vector<double> b);

/// The solution of least squares with normal equations A x = b under one condition: of_sum . x = 1.
[[nodiscard]] std::vector<double> solve_with_sum(const std::vector<double>& a, const std::vector<double>& b,
                                                 const std::vector<double>& of_sum);

}  // namespace thermal
