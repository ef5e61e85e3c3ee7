#include "sensor/flicker_design.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "base/cholesky.h"

namespace thermal {
namespace {

using std::numbers::pi;

constexpr double kLowestCornerHz = 1e-3;
constexpr double kHighestOfKnee = 0.8;  // corners
constexpr double kHighestOfRate = 0.16;
constexpr double kLargestSpacing = 4;
constexpr double kLongestPeriod = 0.8;  // of the time constant
constexpr double kFitFromHz = 3e-3;
constexpr double kFitFromOfRate = 0.1;  // at most
constexpr int kFitPoints = 400;

/// Spectrum of a process of variance 1, relative to that of white noise of variance 1.
double unit_spectrum(const FlickerProcess& process, double frequency_hz, double rate_hz) {
  const double turn = -2 * pi * frequency_hz / rate_hz;
  const double periods = process.period_frames;
  const std::complex<double> frame = std::polar(1.0, turn);
  const std::complex<double> period = std::polar(1.0, turn * periods);
  const double held = std::norm((1.0 - period) / (1.0 - frame)) / periods;
  return (1 - process.keep * process.keep) / std::norm(1.0 - process.keep * period) * held;
}

FlickerProcess process_with(double corner_hz, double rate_hz) {
  const double time_constant_frames = rate_hz / (2 * pi * corner_hz);
  const double longest = std::clamp(kLongestPeriod * time_constant_frames, 1.0, 0x1p24);
  FlickerProcess process;
  process.period_frames = std::bit_floor(static_cast<std::uint32_t>(longest));
  process.keep = std::exp(-static_cast<double>(process.period_frames) / time_constant_frames);
  return process;
}

std::vector<FlickerProcess> spread_processes(double rate_hz, double knee_hz) {
  const double highest_hz = std::min(kHighestOfKnee * knee_hz, kHighestOfRate * rate_hz);
  const double lowest_hz = std::min(kLowestCornerHz, highest_hz);
  const double octaves = std::log2(highest_hz / lowest_hz);
  const int steps = static_cast<int>(std::ceil(octaves / std::log2(kLargestSpacing)));
  std::vector<FlickerProcess> processes;
  for (int step = 0; step <= steps; ++step) {
    const double below = steps == 0 ? 0 : octaves * step / steps;
    processes.push_back(process_with(highest_hz * std::exp2(-below), rate_hz));
  }
  return processes;
}

/// The normal equations of a least-squares fit.
struct Equations {
  std::vector<std::vector<double>> matrix;
  std::vector<double> right;

  void add(const std::vector<double>& terms, double wanted) {
    for (std::size_t i = 0; i < terms.size(); ++i) {
      right[i] += terms[i] * wanted;
      for (std::size_t j = 0; j < terms.size(); ++j) matrix[i][j] += terms[i] * terms[j];
    }
  }
};

/// Solves the equations of the terms in `used`; other terms are 0.
std::vector<double> solve(const Equations& equations, const std::vector<std::size_t>& used) {
  std::vector<double> matrix;
  std::vector<double> right;
  for (const std::size_t i : used) {
    for (const std::size_t j : used) matrix.push_back(equations.matrix[i][j]);
    right.push_back(equations.right[i]);
  }
  const std::vector<double> found = solve_positive_definite(std::move(matrix), std::move(right));
  std::vector<double> solution(equations.right.size());
  for (std::size_t k = 0; k < used.size(); ++k) solution[used[k]] = found[k];
  return solution;
}

/// No term is negative: the most negative one is dropped until none is.
std::vector<double> solve_without_negatives(const Equations& equations) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < equations.right.size(); ++i) used.push_back(i);
  while (true) {
    std::vector<double> solution = solve(equations, used);
    const auto lowest = std::ranges::min_element(solution);
    if (*lowest >= 0) return solution;
    std::erase(used, static_cast<std::size_t>(lowest - solution.begin()));
  }
}

}  // namespace

FlickerDesign FlickerDesign::fit(double rate_hz, double knee_hz) {
  assert(rate_hz > 0 && knee_hz > 0);
  FlickerDesign design;
  design.processes = spread_processes(rate_hz, knee_hz);
  const std::size_t count = design.processes.size() + 1;
  Equations equations{std::vector(count, std::vector<double>(count)), std::vector<double>(count)};
  const double from_hz = std::min(kFitFromHz, kFitFromOfRate * rate_hz);
  for (int point = 0; point < kFitPoints; ++point) {
    const double hz = from_hz * std::pow(0.5 * rate_hz / from_hz, (point + 0.5) / kFitPoints);
    const double weight = knee_hz / (1 + knee_hz / hz);
    std::vector<double> terms;
    for (const FlickerProcess& process : design.processes)
      terms.push_back(weight * unit_spectrum(process, hz, rate_hz));
    terms.push_back(weight);
    equations.add(terms, weight / hz);
  }
  const std::vector<double> variances = solve_without_negatives(equations);
  for (std::size_t k = 0; k + 1 < count; ++k) design.processes[k].variance = variances[k];
  design.white_variance = variances.back();
  std::erase_if(design.processes, [](const FlickerProcess& process) { return process.variance == 0; });
  return design;
}

double FlickerDesign::density(double frequency_hz, double rate_hz) const {
  double sum = white_variance;
  for (const FlickerProcess& process : processes)
    sum += process.variance * unit_spectrum(process, frequency_hz, rate_hz);
  return 2 / rate_hz * sum;
}

double FlickerDesign::variance() const noexcept {
  double sum = white_variance;
  for (const FlickerProcess& process : processes) sum += process.variance;
  return sum;
}

}  // namespace thermal
