#include "sensor/flicker_noise.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/clones.h"
#include "sensor/streams.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

using std::numbers::pi;

constexpr double kLowestHz = 1e-3;
constexpr double kPolesBelowNyquist = 0.3162;  // the highest pole: half a decade below
constexpr double kLevelAt = 0.7;               // Nyquist, where the last zero sets the level
constexpr std::size_t kBlock = 256;

/// |H|^2 of the filter with these poles and zeros at a frequency in cycles per frame.
double gain2(const std::vector<double>& poles, const std::vector<double>& zeros, double cycles_per_frame) {
  const std::complex<double> delay = std::polar(1.0, -2 * pi * cycles_per_frame);
  double gain = 1;
  for (const double pole : poles) gain /= std::norm(1.0 - pole * delay);
  for (const double zero : zeros) gain *= std::norm(1.0 - zero * delay);
  return gain;
}

/// Mean of ln(f |H|^2) over the decades between the first and the last pole.
double mean_log_level(const std::vector<double>& poles, const std::vector<double>& zeros, double low_cycles,
                      double high_cycles) {
  constexpr int kPoints = 64;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double cycles = low_cycles * std::pow(high_cycles / low_cycles, (i + 0.5) / kPoints);
    sum += std::log(cycles * gain2(poles, zeros, cycles));
  }
  return sum / kPoints;
}

/// The last zero, by bisection: the larger it is, the stronger high frequencies are relative to low ones.
double last_zero(const std::vector<double>& poles, std::vector<double> zeros, double low_cycles,
                 double high_cycles) {
  constexpr double kAtCycles = 0.5 * kLevelAt;
  zeros.push_back(0);
  double low = -0.95;
  double high = 0.999;
  for (int step = 0; step < 60; ++step) {
    zeros.back() = 0.5 * (low + high);
    const double level = mean_log_level(poles, zeros, low_cycles, high_cycles);
    const double there = std::log(kAtCycles * gain2(poles, zeros, kAtCycles));
    (there > level ? high : low) = zeros.back();
  }
  return zeros.back();
}

std::vector<double> residues_of(const std::vector<double>& poles, const std::vector<double>& zeros) {
  std::vector<double> residues;
  for (const double pole : poles) {
    double residue = 1;
    for (const double zero : zeros) residue *= 1 - zero / pole;
    for (const double other : poles) {
      if (other != pole) residue /= 1 - other / pole;
    }
    residues.push_back(residue);
  }
  return residues;
}

VELDT_CLONES void step_state(const float* normals, std::size_t count, float pole, float residue, float* state,
                             float* out) {
  for (std::size_t i = 0; i < count; ++i) {
    state[i] = pole * state[i] + normals[i];
    out[i] += residue * state[i];
  }
}

/// Cholesky factor of cov(s_i, s_j) = 1 / (1 - p_i p_j), the states' covariance before a step.
std::vector<double> stationary_factor(const std::vector<double>& poles) {
  const std::size_t n = poles.size();
  std::vector<double> factor(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = 1 / (1 - poles[i] * poles[j]);
      for (std::size_t k = 0; k < j; ++k) rest -= factor[i * n + k] * factor[j * n + k];
      factor[i * n + j] = i == j ? std::sqrt(std::max(0.0, rest)) : rest / factor[j * n + j];
    }
  }
  return factor;
}

std::vector<float> to_floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

}  // namespace

FlickerFilter FlickerFilter::design(double frame_rate_hz, double poles_per_decade) {
  assert(frame_rate_hz > 0 && poles_per_decade > 0);
  const double highest_hz = std::max(2 * kLowestHz, kPolesBelowNyquist * 0.5 * frame_rate_hz);
  const double decades = std::log10(highest_hz / kLowestHz);
  const int steps = std::max(1, static_cast<int>(std::lround(decades * poles_per_decade)));
  FlickerFilter filter;
  std::vector<double> zeros;
  for (int k = 0; k <= steps; ++k) {
    const auto pole_at = [&](double place) {
      return std::exp(-2 * pi * kLowestHz * std::pow(10, decades * place / steps) / frame_rate_hz);
    };
    filter.poles.push_back(pole_at(k));
    if (k < steps) zeros.push_back(pole_at(k + 0.5));
  }
  const double low_cycles = kLowestHz * std::pow(10, 0.5 * decades / steps) / frame_rate_hz;
  const double high_cycles = highest_hz / frame_rate_hz;
  zeros.push_back(last_zero(filter.poles, zeros, low_cycles, high_cycles));
  filter.residues = residues_of(filter.poles, zeros);
  filter.direct = 1;
  for (std::size_t i = 0; i < zeros.size(); ++i) filter.direct *= zeros[i] / filter.poles[i];
  // f |H|^2 / rate becomes 1 Hz / rate, f in cycles per frame.
  const double level = std::exp(mean_log_level(filter.poles, zeros, low_cycles, high_cycles)) * frame_rate_hz;
  const double scale = 1 / std::sqrt(level);
  filter.direct *= scale;
  for (double& residue : filter.residues) residue *= scale;
  return filter;
}

double FlickerFilter::density(double frequency_hz, double frame_rate_hz) const {
  const std::complex<double> delay = std::polar(1.0, -2 * pi * frequency_hz / frame_rate_hz);
  std::complex<double> transfer = direct;
  for (std::size_t k = 0; k < poles.size(); ++k) transfer += residues[k] / (1.0 - poles[k] * delay);
  return 2 / frame_rate_hz * std::norm(transfer);
}

double FlickerFilter::variance() const {
  double sum = direct * direct;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    sum += 2 * direct * residues[i];  // s after the step shares this frame's normal
    for (std::size_t j = 0; j < poles.size(); ++j) {
      sum += residues[i] * residues[j] / (1 - poles[i] * poles[j]);
    }
  }
  return sum;
}

FlickerNoise::FlickerNoise(std::uint32_t seed, std::string_view clip, const FlickerFilter& filter,
                           std::size_t pixels)
    : field_{.seed = seed, .stream = kFlickerStream, .clip = hash_name(clip), .frame = 0},
      poles_(to_floats(filter.poles)),
      residues_(to_floats(filter.residues)),
      direct_(static_cast<float>(filter.direct)),
      start_(stationary_factor(filter.poles)),
      states_(filter.poles.size(), std::vector<float>(pixels)) {}

void FlickerNoise::start(std::size_t first, std::size_t count) {
  std::array<float, kBlock> normals{};
  RandomField field = field_;
  field.frame = restarts_;
  for (std::vector<float>& state : states_) std::ranges::fill(std::span(state).subspan(first, count), 0.0F);
  for (std::size_t column = 0; column < poles_.size(); ++column) {
    field.stream = kFlickerStartStream + static_cast<std::uint32_t>(column);
    fill_normal(field, first, std::span(normals).first(count));
    for (std::size_t row = column; row < poles_.size(); ++row) {
      add_scaled(std::span(normals).first(count), static_cast<float>(start_[row * poles_.size() + column]),
                 std::span(states_[row]).subspan(first, count));
    }
  }
}

void FlickerNoise::add_next(std::uint32_t frame, std::size_t first, float stddev, std::span<float> out) {
  std::array<float, kBlock> normals{};
  RandomField field = field_;
  field.frame = frame;
  for (std::size_t done = 0; done < out.size(); done += kBlock) {
    const std::size_t count = std::min(kBlock, out.size() - done);
    if (frame == begins_) start(first + done, count);
    fill_normal(field, first + done, std::span(normals).first(count));
    const std::span<float> place = out.subspan(done, count);
    add_scaled(std::span(normals).first(count), stddev * direct_, place);
    for (std::size_t k = 0; k < poles_.size(); ++k) {
      step_state(normals.data(), count, poles_[k], stddev * residues_[k], &states_[k][first + done],
                 place.data());
    }
  }
}

}  // namespace thermal
