#include "base/rng.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/catch.h"

namespace rng_test {

using namespace thermal;

namespace {

constexpr std::size_t kPixels = 4096;
constexpr RandomField kField = {.seed = 16, .stream = 3, .clip = hash_name("night_1"), .frame = 12};

using Fill = void (*)(const RandomField&, std::size_t, std::span<float>) noexcept;

std::vector<float> filled(Fill fill, const RandomField& field, std::size_t first, std::size_t count) {
  std::vector<float> values(count);
  fill(field, first, values);
  return values;
}

/// The word from which a value of a field is made: a random number depends on where it is used.
std::uint32_t word_of(const RandomField& field, std::size_t at) {
  const std::size_t batch = at / kRandomBatch;
  const std::size_t word = at % kRandomBatch / 16;
  const Philox4x32::Counter counter = {static_cast<std::uint32_t>(16 * batch + at % 16), field.frame,
                                       static_cast<std::uint32_t>(field.clip),
                                       static_cast<std::uint32_t>(field.clip >> 32)};
  return Philox4x32::generate(counter, {field.seed, field.stream}).at(word);
}

}  // namespace

// Known answers: Random123's own test vectors (Salmon et al., SC 2011), kat_vectors, philox4x32.
TEST_CASE("Philox gives Random123's answers after seven rounds") {
  using Counter = Philox4x32::Counter;
  constexpr std::uint32_t kOnes = 0xFFFFFFFF;
  CHECK(Philox4x32::generate({0, 0, 0, 0}, {0, 0}) ==
        Counter{0x5F6FB709, 0x0D893F64, 0x4F121F81, 0x4F730A48});
  CHECK(Philox4x32::generate({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}) ==
        Counter{0x5207DDC2, 0x45165E59, 0x4D8EE751, 0x8C52F662});
  CHECK(Philox4x32::generate({0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344}, {0xA4093822, 0x299F31D0}) ==
        Counter{0x4DFCCABA, 0x190A87F0, 0xC47362BA, 0xB6B5242A});
}

TEST_CASE("Philox gives Random123's answers after ten rounds") {
  using Counter = Philox4x32::Counter;
  constexpr std::uint32_t kOnes = 0xFFFFFFFF;
  CHECK(Philox4x32::generate({0, 0, 0, 0}, {0, 0}, 10) ==
        Counter{0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8});
  CHECK(Philox4x32::generate({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}, 10) ==
        Counter{0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD});
  CHECK(Philox4x32::generate({0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344}, {0xA4093822, 0x299F31D0},
                             10) == Counter{0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1});
}

// Known answers: the FNV reference test suite (Fowler, Noll, Vo; RFC 9923).
TEST_CASE("Names hash to the published FNV-1a values") {
  CHECK(hash_name("") == 0xCBF29CE484222325);
  CHECK(hash_name("a") == 0xAF63DC4C8601EC8C);
  CHECK(hash_name("foobar") == 0x85944171F73967E8);
}

TEST_CASE("Uniform numbers are the top 24 bits of Philox's words, exactly") {
  const std::vector<float> values = filled(fill_uniform, kField, 0, kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) {
    const std::uint32_t word = word_of(kField, i);
    REQUIRE(values[i] == static_cast<float>(word >> 8) / 16777216.0F);
  }
}

TEST_CASE("Normal numbers are Box and Muller's, to single precision") {
  const std::vector<float> values = filled(fill_normal, kField, 0, kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) {
    if (i % 32 >= 16) continue;  // the second of a pair
    const double u = (static_cast<double>(word_of(kField, i) >> 1) + 1) * 0x1p-31;
    const double radius = std::sqrt(-2 * std::log(u));
    const double angle_rad = 2 * std::numbers::pi * static_cast<double>(word_of(kField, i + 16)) * 0x1p-32;
    // ln u carries the rounding of u to float, the polynomial's error and its rounding, together 2.4e-7 for
    // |ln u| near 1 and 2.4e-7 of itself beyond; the radius moves by d(ln u) / radius. The direction is good to
    // 1.2e-7 and two more roundings follow: 2.4e-7 of the radius.
    const double tolerance = 2.4e-7 * (1 / std::max(radius, 1e-3) + radius) + 2.4e-7 * radius;
    REQUIRE_THAT(static_cast<double>(values[i]), WithinAbs(radius * std::cos(angle_rad), tolerance));
    REQUIRE_THAT(static_cast<double>(values[i + 16]), WithinAbs(radius * std::sin(angle_rad), tolerance));
  }
}

TEST_CASE("Random numbers are the same bits on every machine") {
  std::uint64_t hash = hash_name("");
  for (const float value : filled(fill_normal, kField, 0, kPixels)) {
    hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001B3;
  }
  CHECK(hash == 0x13E09ABDC1C50DB4);  // of GCC 12, x86-64; +, -, *, sqrt round the same everywhere
}

TEST_CASE("Each part of a field's key changes its numbers") {
  const auto fill = GENERATE(fill_uniform, fill_normal);
  const std::vector<float> values = filled(fill, kField, 0, kPixels);
  RandomField other = kField;
  SECTION("seed") { other.seed ^= 1; }
  SECTION("stream") { other.stream ^= 1; }
  SECTION("clip, low half") { other.clip ^= 1; }
  SECTION("clip, high half") { other.clip ^= std::uint64_t{1} << 63; }
  SECTION("frame") { other.frame ^= 1; }
  const std::vector<float> others = filled(fill, other, 0, kPixels);
  int equal = 0;
  for (std::size_t i = 0; i < kPixels; ++i) equal += values[i] == others[i] ? 1 : 0;
  // A pair of 24-bit numbers is equal by chance once in 16.8 million; two pairs of 4096 once in 3e7 trials.
  CHECK(equal <= 1);
}

TEST_CASE("A part of a field, of any length, equals that part of the whole") {
  const auto fill = GENERATE(fill_uniform, fill_normal);
  const std::vector<float> whole = filled(fill, kField, 0, kPixels);
  const auto first = GENERATE(as<std::size_t>{}, 0, 64, 128, 1024);
  const auto count = GENERATE(as<std::size_t>{}, 0, 1, 3, 5, 63, 64, 65, 67, 1001);
  const std::vector<float> part = filled(fill, kField, first, count);
  CHECK(std::equal(part.begin(), part.end(), whole.begin() + static_cast<std::ptrdiff_t>(first)));
}

TEST_CASE("Normal numbers stay within the range of 31 bits") {
  // The smallest u is 2^-31, so that the largest value is sqrt(2 * 31 ln 2) = 6.56.
  const double largest = std::sqrt(2 * 31 * std::numbers::ln2);
  CHECK_THAT(largest, WithinAbs(6.56, 0.005));
  const std::vector<float> values = filled(fill_normal, kField, 0, 1 << 20);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  CHECK(static_cast<double>(*low) >= -largest);
  CHECK(static_cast<double>(*high) <= largest);
  CHECK(static_cast<double>(*high) > 4);  // one in 32 thousand exceeds 4: among a million, certainly one
}

}  // namespace rng_test
