#include "base/rng.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace thermal {
namespace {

constexpr std::size_t kLanes = 16;          // counters worked on together, so that loops vectorise
constexpr std::size_t kBatch = 4 * kLanes;  // numbers they make
using Words = std::array<std::uint32_t, kLanes>;

/// The four output words of counters block, block + 1, …, one array a word.
std::array<Words, 4> generate_lanes(const RandomField& field, std::uint32_t block) noexcept {
  std::array<Words, 4> words{};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Philox4x32::Counter counter = {block + static_cast<std::uint32_t>(lane), field.frame,
                                         static_cast<std::uint32_t>(field.clip),
                                         static_cast<std::uint32_t>(field.clip >> 32)};
    const Philox4x32::Counter out = Philox4x32::generate(counter, {field.seed, field.stream});
    for (std::size_t word = 0; word < 4; ++word) words[word][lane] = out[word];
  }
  return words;
}

/// Uniform in [0, 1) with 24 bits, exactly.
float to_unit(std::uint32_t word) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(word >> 8)) * 0x1p-24F;
}

/// ln of (word + 1) / 2^31 rounded to float, word < 2^31; at most 0.
/// Mantissa in [sqrt(1/2), sqrt(2)), then f - f^2/2 + f^3 Q(f), Q fitted at Chebyshev nodes (error 6e-8).
float log_unit(std::uint32_t word) noexcept {
  const float u = (static_cast<float>(static_cast<std::int32_t>(word)) + 1.0F) * 0x1p-31F;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(u);
  const std::uint32_t offset = bits - 0x3F3504F3;  // bits of sqrt(1/2)
  const std::int32_t exponent = static_cast<std::int32_t>(offset) >> 23;
  const float mantissa = std::bit_cast<float>((offset & 0x007FFFFF) + 0x3F3504F3);
  const float f = mantissa - 1.0F;
  float q = 0.0927221433F;
  q = q * f - 0.141184249F;
  q = q * f + 0.146763966F;
  q = q * f - 0.165928563F;
  q = q * f + 0.199851278F;
  q = q * f - 0.250009217F;
  q = q * f + 0.333334103F;
  return static_cast<float>(exponent) * 0.693147181F + (f - f * f * 0.5F + f * f * f * q);
}

struct SinCos {
  float sin;
  float cos;
};

/// Sine and cosine of word / 2^32 of a full turn: the octant from the top bits, the rest by polynomial on
/// +-1/8 turn (errors 3e-9 and 5e-11 before rounding).
SinCos turn(std::uint32_t word) noexcept {
  const std::uint32_t quarter = (word + 0x20000000U) >> 30;
  const auto rest = static_cast<std::int32_t>(word - (quarter << 30));
  const float v = static_cast<float>(rest) * 0x1p-32F;
  const float v2 = v * v;
  const float s = v * (6.28318529F + v2 * (-41.3416626F + v2 * (81.5925482F + v2 * -75.4018403F)));
  const float c = 1.0F + v2 * (-19.7392087F + v2 * (64.9393162F + v2 * (-85.4428484F + v2 * 59.2202879F)));
  const bool odd = (quarter & 1U) != 0;
  const float sine = odd ? c : s;
  const float cosine = odd ? s : c;
  return {quarter >= 2 ? -sine : sine, (quarter == 1 || quarter == 2) ? -cosine : cosine};
}

/// Writes values [first, first + out.size()) where make(block, batch) fills a whole batch.
template <typename MakeBatch>
void fill(std::size_t first, std::span<float> out, MakeBatch make) noexcept {
  assert(first % 4 == 0);
  std::array<float, kBatch> batch{};
  for (std::size_t done = 0; done < out.size(); done += kBatch) {
    make(static_cast<std::uint32_t>((first + done) / 4), batch);
    const std::size_t count = std::min(kBatch, out.size() - done);
    std::copy_n(batch.begin(), count, out.begin() + static_cast<std::ptrdiff_t>(done));
  }
}

}  // namespace

void fill_uniform(const RandomField& field, std::size_t first, std::span<float> out) noexcept {
  fill(first, out, [&field](std::uint32_t block, std::array<float, kBatch>& batch) {
    const std::array<Words, 4> words = generate_lanes(field, block);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      for (std::size_t word = 0; word < 4; ++word) batch[4 * lane + word] = to_unit(words[word][lane]);
    }
  });
}

void fill_normal(const RandomField& field, std::size_t first, std::span<float> out) noexcept {
  fill(first, out, [&field](std::uint32_t block, std::array<float, kBatch>& batch) {
    const std::array<Words, 4> words = generate_lanes(field, block);
    for (std::size_t pair = 0; pair < 4; pair += 2) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float radius = std::sqrt(-2.0F * log_unit(words[pair][lane] >> 1));
        const SinCos direction = turn(words[pair + 1][lane]);
        batch[4 * lane + pair] = radius * direction.cos;
        batch[4 * lane + pair + 1] = radius * direction.sin;
      }
    }
  });
}

}  // namespace thermal
