#include "base/rng.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/clones.h"

#if VELDT_HAS_CLONES
#include <immintrin.h>
#endif

namespace thermal {
namespace {

constexpr std::size_t kLanes = 16;  // counters processed together, so that loops vectorise
using Words = std::array<std::uint32_t, kLanes>;

/// The four output words of counters block, block + 1, …, one array per word: Philox4x32::generate() with one lane
/// per counter.
VELDT_DEFAULT_TARGET void generate_lanes(const RandomField& field, std::uint32_t block,
                                         std::array<Words, 4>& words) noexcept {
  const auto clip_low = static_cast<std::uint32_t>(field.clip);
  const auto clip_high = static_cast<std::uint32_t>(field.clip >> 32);
  const std::uint32_t frame = field.frame;
  const Philox4x32::Key first_key = {field.seed, field.stream};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    std::uint32_t c0 = block + static_cast<std::uint32_t>(lane);
    std::uint32_t c1 = frame;
    std::uint32_t c2 = clip_low;
    std::uint32_t c3 = clip_high;
    std::uint32_t k0 = first_key[0];
    std::uint32_t k1 = first_key[1];
#pragma GCC unroll 7
    for (int round = 0; round < Philox4x32::kRounds; ++round) {
      const std::uint64_t a = std::uint64_t{Philox4x32::kFirst} * c0;
      const std::uint64_t b = std::uint64_t{Philox4x32::kSecond} * c2;
      c0 = static_cast<std::uint32_t>(b >> 32) ^ c1 ^ k0;
      c1 = static_cast<std::uint32_t>(b);
      c2 = static_cast<std::uint32_t>(a >> 32) ^ c3 ^ k1;
      c3 = static_cast<std::uint32_t>(a);
      k0 += Philox4x32::kFirstKeyStep;
      k1 += Philox4x32::kSecondKeyStep;
    }
    words[0][lane] = c0;
    words[1][lane] = c1;
    words[2][lane] = c2;
    words[3][lane] = c3;
  }
}

#if VELDT_HAS_CLONES
/// The same bits, faster: each counter keeps a lane of 64 bits, whose upper half is undefined, because the
/// multiplication ignores it; compilers shuffle halves of products instead. Even and odd counters have separate
/// vectors, which are merged at the end.
__attribute__((target("avx2"))) void generate_lanes(const RandomField& field, std::uint32_t block,
                                                    std::array<Words, 4>& words) noexcept {
  constexpr std::size_t kVector = 8;  // counters in an even and an odd vector
  const __m256i first = _mm256_set1_epi64x(Philox4x32::kFirst);
  const __m256i second = _mm256_set1_epi64x(Philox4x32::kSecond);
  const __m256i frame = _mm256_set1_epi64x(field.frame);
  const __m256i clip_low = _mm256_set1_epi64x(static_cast<std::int64_t>(field.clip));
  const __m256i clip_high = _mm256_set1_epi64x(static_cast<std::int64_t>(field.clip >> 32));
  for (std::size_t lane = 0; lane < kLanes; lane += kVector) {
    const auto base = static_cast<std::int64_t>(block + lane);
    __m256i c[2][4] = {
        {_mm256_setr_epi64x(base, base + 2, base + 4, base + 6), frame, clip_low, clip_high},
        {_mm256_setr_epi64x(base + 1, base + 3, base + 5, base + 7), frame, clip_low, clip_high}};
    Philox4x32::Key key = {field.seed, field.stream};
#pragma GCC unroll 7
    for (int round = 0; round < Philox4x32::kRounds; ++round) {
      const __m256i k0 = _mm256_set1_epi64x(key[0]);
      const __m256i k1 = _mm256_set1_epi64x(key[1]);
#pragma GCC unroll 2
      for (__m256i(&one)[4] : c) {
        const __m256i a = _mm256_mul_epu32(one[0], first);
        const __m256i b = _mm256_mul_epu32(one[2], second);
        one[0] = _mm256_xor_si256(_mm256_srli_epi64(b, 32), _mm256_xor_si256(one[1], k0));
        one[1] = b;
        one[2] = _mm256_xor_si256(_mm256_srli_epi64(a, 32), _mm256_xor_si256(one[3], k1));
        one[3] = a;
      }
      key = {key[0] + Philox4x32::kFirstKeyStep, key[1] + Philox4x32::kSecondKeyStep};
    }
    for (std::size_t word = 0; word < words.size(); ++word) {
      const __m256i both = _mm256_blend_epi32(c[0][word], _mm256_slli_epi64(c[1][word], 32), 0b10101010);
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(&words[word][lane]), both);
    }
  }
}
#endif

/// Uniform in [0, 1) with 24 bits, exactly.
VELDT_INLINE float to_unit(std::uint32_t word) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(word >> 8)) * 0x1p-24F;
}

/// ln of (word + 1) / 2^31 rounded to float, word < 2^31; at most 0.
/// Mantissa in [sqrt(1/2), sqrt(2)), then f - f^2/2 + f^3 Q(f), Q fitted at Chebyshev nodes (error 6e-8).
VELDT_INLINE float log_unit(std::uint32_t word) noexcept {
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

/// The value, negated if the second bit of `quarter` is set.
VELDT_INLINE float with_sign(float value, std::uint32_t quarter) noexcept {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ ((quarter & 2U) << 30));
}

/// Sine and cosine of word / 2^32 of a full turn: the octant from the top bits, the rest by polynomial on
/// +-1/8 turn (errors 3e-9 and 5e-11 before rounding).
VELDT_INLINE SinCos turn(std::uint32_t word) noexcept {
  const std::uint32_t quarter = (word + 0x20000000U) >> 30;
  const auto rest = static_cast<std::int32_t>(word - (quarter << 30));
  const float v = static_cast<float>(rest) * 0x1p-32F;
  const float v2 = v * v;
  const float s = v * (6.28318529F + v2 * (-41.3416626F + v2 * (81.5925482F + v2 * -75.4018403F)));
  const float c = 1.0F + v2 * (-19.7392087F + v2 * (64.9393162F + v2 * (-85.4428484F + v2 * 59.2202879F)));
  const bool odd = (quarter & 1U) != 0;
  return {with_sign(odd ? c : s, quarter), with_sign(odd ? s : c, quarter + 1)};
}

VELDT_CLONES void uniform_batches(const RandomField& field, std::uint32_t block, std::size_t batches,
                                  float* out) noexcept {
  std::array<Words, 4> words{};
  for (std::size_t batch = 0; batch < batches; ++batch) {
    generate_lanes(field, block + static_cast<std::uint32_t>(batch * kLanes), words);
    for (std::size_t word = 0; word < 4; ++word) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) *out++ = to_unit(words[word][lane]);
    }
  }
}

VELDT_CLONES void normal_batches(const RandomField& field, std::uint32_t block, std::size_t batches,
                                 float* out) noexcept {
  std::array<Words, 4> words{};
  for (std::size_t batch = 0; batch < batches; ++batch, out += kRandomBatch) {
    generate_lanes(field, block + static_cast<std::uint32_t>(batch * kLanes), words);
    for (std::size_t pair = 0; pair < 4; pair += 2) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float radius = std::sqrt(-2.0F * log_unit(words[pair][lane] >> 1));
        const SinCos direction = turn(words[pair + 1][lane]);
        out[pair * kLanes + lane] = radius * direction.cos;
        out[(pair + 1) * kLanes + lane] = radius * direction.sin;
      }
    }
  }
}

/// Writes values [first, first + out.size()), where make(block, batches, out) makes whole batches.
template <typename MakeBatches>
void fill(std::size_t first, std::span<float> out, MakeBatches make) noexcept {
  assert(first % kRandomBatch == 0);
  const std::size_t whole = out.size() / kRandomBatch;
  make(static_cast<std::uint32_t>(first / 4), whole, out.data());
  const std::span<float> rest = out.subspan(whole * kRandomBatch);
  if (rest.empty()) return;
  std::array<float, kRandomBatch> batch{};
  make(static_cast<std::uint32_t>(first / 4 + whole * kLanes), 1, batch.data());
  std::copy_n(batch.begin(), rest.size(), rest.begin());
}

}  // namespace

void fill_uniform(const RandomField& field, std::size_t first, std::span<float> out) noexcept {
  fill(first, out, [&field](std::uint32_t block, std::size_t batches, float* place) {
    uniform_batches(field, block, batches, place);
  });
}

void fill_normal(const RandomField& field, std::size_t first, std::span<float> out) noexcept {
  fill(first, out, [&field](std::uint32_t block, std::size_t batches, float* place) {
    normal_batches(field, block, batches, place);
  });
}

std::vector<float> normal_values(const RandomField& field, int count) {
  std::vector<float> values(static_cast<std::size_t>(count));
  fill_normal(field, 0, values);
  return values;
}

}  // namespace thermal
