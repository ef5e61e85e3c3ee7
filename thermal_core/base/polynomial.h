#pragma once

#include <functional>
#include <vector>

namespace thermal {

/// Coefficients, lowest power first, of the polynomial through a function's values at the Chebyshev points of
/// [-1, 1]: within a few times the error of the best one of its degree. `terms` from 1 to 16.
[[nodiscard]] std::vector<double> fit_polynomial(const std::function<double(double)>& function, int terms);

}  // namespace thermal
