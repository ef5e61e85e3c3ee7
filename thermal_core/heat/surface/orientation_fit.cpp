#include "heat/surface/orientation_fit.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace thermal {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Solves a * x = b for symmetric positive a and several right-hand sides, by elimination; b becomes x.
void solve(Matrix& a, Matrix& b) {
  const std::size_t size = a.size();
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t row = 0; row < size; ++row) {
      if (row == k) continue;
      const double factor = a[row][k] / a[k][k];
      for (std::size_t column = k; column < size; ++column) a[row][column] -= factor * a[k][column];
      for (std::size_t column = 0; column < b[k].size(); ++column) b[row][column] -= factor * b[k][column];
    }
  }
  for (std::size_t k = 0; k < size; ++k) {
    for (double& value : b[k]) value /= a[k][k];
  }
}

std::vector<EastNorthUp> up_and_aspects(const std::vector<double>& slopes_deg) {
  std::vector<EastNorthUp> directions = {{0, 0, 1}};
  for (const double slope_deg : slopes_deg) {
    const double slope = slope_deg * std::numbers::pi / 180;
    for (int aspect = 0; aspect < 8; ++aspect) {
      const double turn = aspect * std::numbers::pi / 4;
      directions.push_back(
          {std::sin(slope) * std::sin(turn), std::sin(slope) * std::cos(turn), std::cos(slope)});
    }
  }
  return directions;
}

}  // namespace

std::array<double, Orientation::kTerms> Orientation::terms_of(const EastNorthUp& n) noexcept {
  return {1, n[0], n[1], n[2], n[0] * n[0], n[1] * n[1], n[0] * n[1], n[0] * n[2], n[1] * n[2]};
}

double Orientation::at(const EastNorthUp& normal) const noexcept {
  const auto terms = terms_of(normal);
  double sum = 0;
  for (std::size_t i = 0; i < kTerms; ++i) sum += coefficients[i] * terms[i];
  return sum;
}

OrientationFit OrientationFit::of_ground() { return {{20, 40}, {0, 1, 2, 4, 5, 6}}; }

OrientationFit OrientationFit::of_bodies() { return {{45, 90, 135}, {0, 1, 2, 3, 4, 5, 6, 7, 8}}; }

OrientationFit OrientationFit::of_level() { return {{}, {0}}; }

OrientationFit::OrientationFit(std::vector<double> slopes_deg, std::vector<std::size_t> terms)
    : directions_(up_and_aspects(slopes_deg)), terms_(std::move(terms)), weights_(directions_.size(), 1) {
  if (terms_.size() < Orientation::kTerms) weights_.front() = static_cast<double>(directions_.size());
  Matrix normal(terms_.size(), std::vector<double>(terms_.size()));
  Matrix right(terms_.size(), std::vector<double>(directions_.size()));
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const auto all = Orientation::terms_of(directions_[d]);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      right[i][d] = weights_[d] * all.at(terms_[i]);
      for (std::size_t j = 0; j < terms_.size(); ++j) normal[i][j] += right[i][d] * all.at(terms_[j]);
    }
  }
  solve(normal, right);
  fit_ = std::move(right);
}

Orientation OrientationFit::fit(std::span<const double> values) const {
  assert(values.size() == directions_.size());
  Orientation fitted;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    for (std::size_t d = 0; d < values.size(); ++d)
      fitted.coefficients.at(terms_[i]) += fit_[i][d] * values[d];
  }
  return fitted;
}

}  // namespace thermal
