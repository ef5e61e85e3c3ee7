#include "bench/ou_bank.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "base/cholesky.h"
#include "base/clones.h"

namespace thermal {
namespace {

using std::numbers::pi;

constexpr double kLowestHz = 1e-3;
constexpr double kHighestOfNyquist = 0.3162;
constexpr std::size_t kBlock = 256;

/// Spectrum of a process of variance 1.
double unit_density(double decay, double frequency_hz, double rate_hz) {
  const std::complex<double> delay = std::polar(1.0, -2 * pi * frequency_hz / rate_hz);
  return 2 / rate_hz * (1 - decay * decay) / std::norm(1.0 - decay * delay);
}

VELDT_CLONES void step_process(const float* normals, std::size_t count, float keep, float renew, float stddev,
                               float* state, float* out) {
  for (std::size_t i = 0; i < count; ++i) {
    state[i] = keep * state[i] + renew * normals[i];
    out[i] += stddev * state[i];
  }
}

}  // namespace

OuBank OuBank::design(double rate_hz, int processes) {
  constexpr int kPoints = 400;
  const auto n = static_cast<std::size_t>(processes);
  const double ratio = kHighestOfNyquist * 0.5 * rate_hz / kLowestHz;
  OuBank bank;
  for (int k = 0; k < processes; ++k) {
    const double corner_hz = kLowestHz * std::pow(ratio, static_cast<double>(k) / (processes - 1));
    bank.decays.push_back(std::exp(-2 * pi * corner_hz / rate_hz));
  }
  std::vector<double> normal_matrix(n * n);
  std::vector<double> right(n);
  std::vector<double> shares(n);
  for (int point = 0; point < kPoints; ++point) {
    const double lowest_hz = 3 * kLowestHz;
    const double frequency_hz = lowest_hz * std::pow(0.5 * rate_hz / lowest_hz, (point + 0.5) / kPoints);
    const double wanted = 2 / rate_hz / frequency_hz;
    for (std::size_t k = 0; k < n; ++k)
      shares[k] = unit_density(bank.decays[k], frequency_hz, rate_hz) / wanted;
    for (std::size_t i = 0; i < n; ++i) {
      right[i] += shares[i];
      for (std::size_t j = 0; j < n; ++j) normal_matrix[i * n + j] += shares[i] * shares[j];
    }
  }
  bank.variances = solve_positive_definite(std::move(normal_matrix), std::move(right));
  return bank;
}

double OuBank::density(double frequency_hz, double rate_hz) const {
  double sum = 0;
  for (std::size_t k = 0; k < decays.size(); ++k) {
    sum += variances[k] * unit_density(decays[k], frequency_hz, rate_hz);
  }
  return sum;
}

double OuBank::variance() const {
  double sum = 0;
  for (const double one : variances) sum += one;
  return sum;
}

OuNoise::OuNoise(std::uint32_t seed, std::string_view clip, OuBank bank, std::size_t pixels)
    : field_{.seed = seed, .stream = 0, .clip = hash_name(clip), .frame = 0},
      bank_(std::move(bank)),
      states_(bank_.decays.size(), std::vector<float>(pixels)) {}

void OuNoise::add_next(std::uint32_t frame, std::span<float> out) {
  std::array<float, kBlock> normals{};
  for (std::size_t first = 0; first < out.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, out.size() - first);
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const double decay = frame == 0 ? 0 : bank_.decays[k];
      RandomField field = field_;
      field.frame = frame;
      field.stream = static_cast<std::uint32_t>(k);
      fill_normal(field, first, std::span(normals).first(count));
      step_process(normals.data(), count, static_cast<float>(decay),
                   static_cast<float>(std::sqrt(1 - decay * decay)),
                   static_cast<float>(std::sqrt(bank_.variances[k])), &states_[k][first], &out[first]);
    }
  }
}

}  // namespace thermal
