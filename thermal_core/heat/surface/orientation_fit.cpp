#include "heat/surface/orientation_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace thermal {
namespace {

constexpr std::size_t kSunTerm = Orientation::kTerms - 1;

/// An equation a x = b of normal equations, symmetric and positive; solved by elimination, b becomes x.
using Matrix = std::array<std::array<double, Orientation::kTerms>, Orientation::kTerms>;
using Right = std::array<double, Orientation::kTerms>;

void solve(Matrix& a, Right& b, std::size_t size) {
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t row = 0; row < size; ++row) {
      if (row == k) continue;
      const double factor = a.at(row).at(k) / a.at(k).at(k);
      for (std::size_t column = k; column < size; ++column)
        a.at(row).at(column) -= factor * a.at(k).at(column);
      b.at(row) -= factor * b.at(k);
    }
  }
  for (std::size_t k = 0; k < size; ++k) b.at(k) /= a.at(k).at(k);
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

std::array<double, Orientation::kTerms> Orientation::terms_of(const EastNorthUp& n,
                                                              const EastNorthUp& sun) noexcept {
  const double cosine = n[0] * sun[0] + n[1] * sun[1] + n[2] * sun[2];
  return {1,           n[0],        n[1],        n[2],        n[0] * n[0],
          n[1] * n[1], n[0] * n[1], n[0] * n[2], n[1] * n[2], std::max(0.0, cosine)};
}

double Orientation::at(const EastNorthUp& normal) const noexcept {
  const auto terms = terms_of(normal, sun);
  double sum = 0;
  for (std::size_t i = 0; i < kTerms; ++i) sum += coefficients[i] * terms[i];
  return sum;
}

OrientationFit OrientationFit::of_ground() { return {{20, 40}, {0, 1, 2, 4, 5, 6}}; }

OrientationFit OrientationFit::of_bodies() {
  OrientationFit fit({45, 90, 135}, {0, 1, 2, 3, 4, 5, 6, 7, 8});
  fit.directions_.push_back({0, 0, -1});
  fit.weights_.push_back(1);
  return fit;
}

OrientationFit OrientationFit::of_level() { return {{}, {0}}; }

OrientationFit::OrientationFit(std::vector<double> slopes_deg, std::vector<std::size_t> terms)
    : directions_(up_and_aspects(slopes_deg)), terms_(std::move(terms)), weights_(directions_.size(), 1) {
  if (terms_.size() < kSunTerm) weights_.front() = static_cast<double>(directions_.size());
}

Orientation OrientationFit::fit(std::span<const double> values, const EastNorthUp& sun) const {
  assert(values.size() == directions_.size());
  constexpr double kLeastSquare = 1e-9;  // keeps the equations solvable where two terms are alike
  std::vector<std::size_t> terms = terms_;
  if (sun[2] > 0 && directions_.size() > 1) terms.push_back(kSunTerm);
  Matrix normal{};
  Right right{};
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const auto all = Orientation::terms_of(directions_[d], sun);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const double weighted = weights_[d] * all.at(terms[i]);
      right.at(i) += weighted * values[d];
      for (std::size_t j = 0; j < terms.size(); ++j) normal.at(i).at(j) += weighted * all.at(terms[j]);
    }
  }
  for (std::size_t i = 0; i < terms.size(); ++i) normal.at(i).at(i) += kLeastSquare;
  solve(normal, right, terms.size());
  Orientation fitted;
  fitted.sun = sun;
  for (std::size_t i = 0; i < terms.size(); ++i) fitted.coefficients.at(terms[i]) = right.at(i);
  if (weights_.front() > 1) fitted.coefficients[0] += values.front() - fitted.at(directions_.front());
  return fitted;
}

EastNorthUp sun_of_surfaces(const SunPath& path, double solar_h) noexcept {
  constexpr double kBeforeH = 0.2;
  const EastNorthUp sun = sun_direction(path, solar_h - kBeforeH);
  return sun[2] > 0 ? sun : EastNorthUp{0, 0, 0};
}

}  // namespace thermal
