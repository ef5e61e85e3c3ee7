#include "sensor/flicker_noise.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/clones.h"
#include "sensor/streams.h"
#include "sensor/vector_math.h"

namespace thermal {
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
