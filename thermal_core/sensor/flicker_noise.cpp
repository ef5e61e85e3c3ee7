#include "sensor/flicker_noise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "base/cholesky.h"
#include "base/clones.h"
#include "sensor/streams.h"
#include "sensor/vector_math.h"

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

namespace {

constexpr std::size_t kBlockPixels = FlickerNoise::kBlockPixels;
constexpr std::uint64_t kNotStarted = std::numeric_limits<std::uint64_t>::max();

VELDT_CLONES void renew(const float* normals, float keep, float scale, float* state) {
  for (std::size_t i = 0; i < kBlockPixels; ++i) state[i] = keep * state[i] + scale * normals[i];
}

}  // namespace

FlickerNoise::FlickerNoise(std::uint32_t seed, std::string_view clip, const FlickerDesign& design,
                           std::size_t pixels)
    : field_{.seed = seed, .stream = kFlickerStream, .clip = hash_name(clip), .frame = 0}, design_(design) {
  const std::size_t blocks = (pixels + kBlockPixels - 1) / kBlockPixels;
  ticks_.assign(blocks, kNotStarted);
  states_.resize(blocks * design.processes.size() * kBlockPixels);
  slow_.resize(blocks * kBlockPixels);
  sums_.resize(blocks * kBlockPixels);
  if (design.processes.empty()) return;
  period_ = design.processes.front().period_frames;
  std::vector<float> turns(blocks);
  RandomField phases = field_;
  phases.stream = kFlickerPhaseStream;
  fill_uniform(phases, 0, turns);
  const auto all_frames = static_cast<double>(design.processes.back().period_frames);
  for (const float turn : turns)
    phases_.push_back(static_cast<std::uint32_t>(static_cast<double>(turn) * all_frames));
}

void FlickerNoise::restart_at(std::uint32_t frame, std::uint32_t event) {
  begins_ = frame;
  event_ = event;
  std::ranges::fill(ticks_, kNotStarted);
}

float* FlickerNoise::state(std::size_t block, std::size_t process) noexcept {
  return states_.data() + (block * design_.processes.size() + process) * kBlockPixels;
}

void FlickerNoise::sum_slow(std::size_t block) {
  const std::span<float> sum = std::span(slow_).subspan(block * kBlockPixels, kBlockPixels);
  std::ranges::fill(sum, 0.0F);
  for (std::size_t k = 1; k < design_.processes.size(); ++k)
    add_scaled(std::span(state(block, k), kBlockPixels), 1, sum);
}

void FlickerNoise::start(std::size_t block) {
  std::array<float, kBlockPixels> normals{};
  RandomField field = field_;
  field.frame = event_;
  for (std::size_t k = 0; k < design_.processes.size(); ++k) {
    field.stream = kFlickerStartStream + static_cast<std::uint32_t>(k);
    fill_normal(field, block * kBlockPixels, normals);
    renew(normals.data(), 0, static_cast<float>(std::sqrt(design_.processes[k].variance)), state(block, k));
  }
  sum_slow(block);
}

void FlickerNoise::tick(std::size_t block, std::uint64_t tick) {
  std::array<float, kBlockPixels> normals{};
  RandomField field = field_;
  std::size_t k = 0;
  for (; k < design_.processes.size(); ++k) {
    const FlickerProcess& process = design_.processes[k];
    const std::uint64_t ratio = process.period_frames / period_;
    if (tick % ratio != 0) break;  // nor do slower ones tick
    field.stream = kFlickerStream + static_cast<std::uint32_t>(k);
    field.frame = static_cast<std::uint32_t>(tick / ratio);
    fill_normal(field, block * kBlockPixels, normals);
    const double renewed = std::sqrt((1 - process.keep * process.keep) * process.variance);
    renew(normals.data(), static_cast<float>(process.keep), static_cast<float>(renewed), state(block, k));
  }
  if (k > 1) sum_slow(block);
}

void FlickerNoise::advance(std::size_t block, std::uint32_t frame) {
  const std::uint64_t now = (std::uint64_t{phases_[block]} + frame) / period_;
  if (ticks_[block] == now) return;
  if (ticks_[block] == kNotStarted) {
    start(block);
    ticks_[block] = (std::uint64_t{phases_[block]} + begins_) / period_;
  }
  while (ticks_[block] < now) tick(block, ++ticks_[block]);
  const auto of_block = [block](std::span<float> plane) {
    return plane.subspan(block * kBlockPixels, kBlockPixels);
  };
  set_sum(std::span(state(block, 0), kBlockPixels), 1, of_block(slow_), 1, of_block(sums_));
}

void FlickerNoise::add(std::uint32_t frame, std::size_t first, float stddev, std::span<float> out) {
  assert(first % kBlockPixels == 0);
  if (design_.processes.empty()) return;
  const std::size_t end = (first + out.size() + kBlockPixels - 1) / kBlockPixels;
  for (std::size_t block = first / kBlockPixels; block < end; ++block) advance(block, frame);
  add_scaled(std::span(sums_).subspan(first, out.size()), stddev, out);
}

}  // namespace thermal
