#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace thermal {

/// Philox 4x32, a counter-based generator: a bijection of the counter for every key, so that a random number
/// is a function of where it is used and not of what was drawn before (Salmon et al., SC 2011).
/// Seven rounds pass BigCrush there.
struct Philox4x32 {
  using Counter = std::array<std::uint32_t, 4>;
  using Key = std::array<std::uint32_t, 2>;
  static constexpr int kRounds = 7;
  static constexpr std::uint32_t kFirst = 0xD2511F53;  // multipliers of the two halves
  static constexpr std::uint32_t kSecond = 0xCD9E8D57;
  static constexpr std::uint32_t kFirstKeyStep = 0x9E3779B9;
  static constexpr std::uint32_t kSecondKeyStep = 0xBB67AE85;

  [[nodiscard]] static constexpr Counter generate(Counter counter, Key key, int rounds = kRounds) noexcept {
    for (int round = 0; round < rounds; ++round) {
      const std::uint64_t a = std::uint64_t{kFirst} * counter[0];
      const std::uint64_t b = std::uint64_t{kSecond} * counter[2];
      counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                 static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
      key = {key[0] + kFirstKeyStep, key[1] + kSecondKeyStep};
    }
    return counter;
  }
};

/// Identifies one field of random numbers with one value per pixel: every (seed, stream, clip, frame) has its own.
struct RandomField {
  std::uint32_t seed = 0;    ///< of the dataset
  std::uint32_t stream = 0;  ///< what the numbers are for
  std::uint64_t clip = 0;    ///< hash_name() of the clip's id
  std::uint32_t frame = 0;   ///< index in the clip
};

/// 64-bit FNV-1a hash of a name, the same on every machine.
[[nodiscard]] constexpr std::uint64_t hash_name(std::string_view name) noexcept {
  std::uint64_t hash = 0xCBF29CE484222325;
  for (const char letter : name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001B3;
  }
  return hash;
}

/// Numbers are generated in batches of this size.
inline constexpr std::size_t kRandomBatch = 64;

/// Values [first, first + out.size()) of a field, uniform in [0, 1). `first` is a multiple of kRandomBatch.
/// Value 64 b + 16 w + l is made of word w of counter 16 b + l.
void fill_uniform(const RandomField& field, std::size_t first, std::span<float> out) noexcept;

/// The same for the standard normal distribution (Box and Muller 1958), |value| <= 6.7. Logarithm and sine are our
/// own polynomials (absolute error below 3e-7 of the value's scale), so that the bits do not depend on the C library.
/// `first` is a multiple of kRandomBatch.
void fill_normal(const RandomField& field, std::size_t first, std::span<float> out) noexcept;

/// The first `count` of these.
[[nodiscard]] std::vector<float> normal_values(const RandomField& field, int count);

}  // namespace thermal
