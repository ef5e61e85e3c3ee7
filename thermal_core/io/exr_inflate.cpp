#include "io/exr_inflate.h"

#include <cstdint>
#include <cstring>
#include <new>

#include <libdeflate.h>

namespace thermal {
namespace {

constexpr std::uint64_t kHighBits = 0x8080808080808080U;
constexpr std::uint64_t kOnes = 0x0101010101010101U;

/// Sums of eight pairs of bytes, each modulo 256.
std::uint64_t add_bytes(std::uint64_t a, std::uint64_t b) noexcept {
  return ((a & ~kHighBits) + (b & ~kHighBits)) ^ ((a ^ b) & kHighBits);
}

/// Replaces each byte but the first by the sum of all bytes up to it, minus 128 per step; eight at a time.
void sum_differences(std::span<std::byte> bytes) noexcept {
  auto sum = std::to_integer<std::uint64_t>(bytes.front());
  std::size_t i = 1;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, &bytes[i], 8);
    eight ^= kHighBits;  // less 128
    eight = add_bytes(eight, eight << 8U);
    eight = add_bytes(eight, eight << 16U);
    eight = add_bytes(eight, eight << 32U);
    eight = add_bytes(eight, sum * kOnes);
    std::memcpy(&bytes[i], &eight, 8);
    sum = eight >> 56U;
  }
  for (; i < bytes.size(); ++i) {
    sum = (sum + std::to_integer<std::uint64_t>(bytes[i]) + 128) & 0xFFU;
    bytes[i] = static_cast<std::byte>(sum);
  }
}

/// Even bytes from the first half, odd ones from the second; with an odd count the last is in the first half.
void join_halves(std::span<const std::byte> halves, std::byte* out) noexcept {
  const std::size_t pairs = halves.size() / 2;
  const std::byte* const even = halves.data();
  const std::byte* const odd = even + (halves.size() + 1) / 2;
  for (std::size_t i = 0; i < pairs; ++i) {
    out[2 * i] = even[i];
    out[2 * i + 1] = odd[i];
  }
  if (halves.size() % 2 == 1) out[2 * pairs] = even[pairs];
}

}  // namespace

void ExrInflater::Free::operator()(libdeflate_decompressor* decompressor) const noexcept {
  libdeflate_free_decompressor(decompressor);
}

ExrInflater::ExrInflater() = default;
ExrInflater::~ExrInflater() = default;

bool ExrInflater::reserve(std::size_t size) noexcept {
  try {
    if (!decompressor_) decompressor_.reset(libdeflate_alloc_decompressor());
    halves_.resize(size);
  } catch (const std::bad_alloc&) {
    return false;
  }
  return decompressor_ != nullptr;
}

bool ExrInflater::inflate(std::span<const std::byte> packed, std::span<std::byte> bytes) noexcept {
  if (bytes.empty() || !reserve(bytes.size())) return false;
  std::size_t written = 0;
  const libdeflate_result result = libdeflate_zlib_decompress(
      decompressor_.get(), packed.data(), packed.size(), halves_.data(), halves_.size(), &written);
  if (result != LIBDEFLATE_SUCCESS || written != bytes.size()) return false;
  sum_differences(halves_);
  join_halves(halves_, bytes.data());
  return true;
}

}  // namespace thermal
