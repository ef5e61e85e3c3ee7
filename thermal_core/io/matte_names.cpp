#include "io/matte_names.h"

#include <bit>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

std::uint32_t scrambled(std::uint32_t block) noexcept {
  return std::rotl(block * 0xCC9E2D51U, 15) * 0x1B873593U;
}

/// Up to four bytes, little-endian on every machine.
std::uint32_t block_of(std::string_view bytes) noexcept {
  std::uint32_t block = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    block |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return block;
}

std::uint32_t murmur_hash(std::string_view bytes) noexcept {
  std::uint32_t hash = 0;
  const auto length = static_cast<std::uint32_t>(bytes.size());
  for (; bytes.size() >= 4; bytes.remove_prefix(4)) {
    hash = std::rotl(hash ^ scrambled(block_of(bytes.substr(0, 4))), 13) * 5 + 0xE6546B64U;
  }
  hash ^= scrambled(block_of(bytes)) ^ length;
  hash = (hash ^ (hash >> 16)) * 0x85EBCA6BU;
  hash = (hash ^ (hash >> 13)) * 0xC2B2AE35U;
  return hash ^ (hash >> 16);
}

}  // namespace

std::uint32_t hash_in_float(std::uint32_t hash) noexcept {
  const std::uint32_t exponent = (hash >> 23) & 0xFF;
  return exponent == 0 || exponent == 0xFF ? hash ^ (1U << 23) : hash;
}

std::uint32_t cryptomatte_hash(std::string_view name) noexcept { return hash_in_float(murmur_hash(name)); }

bool matches_matte(std::string_view pattern, std::string_view name) noexcept {
  // After a mismatch, the last star takes one more letter, so that the time is at most the product of both lengths.
  std::size_t in_pattern = 0;
  std::size_t in_name = 0;
  std::size_t after_star = std::string_view::npos;
  std::size_t star_ends = 0;
  while (in_name < name.size()) {
    if (in_pattern < pattern.size() && pattern[in_pattern] == '*') {
      after_star = ++in_pattern;
      star_ends = in_name;
    } else if (in_pattern < pattern.size() && pattern[in_pattern] == name[in_name]) {
      ++in_pattern;
      ++in_name;
    } else if (after_star != std::string_view::npos) {
      in_pattern = after_star;
      in_name = ++star_ends;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', in_pattern) == std::string_view::npos;
}

MatteNames::MatteNames(std::span<const ManifestObject> objects) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ManifestObject& object = objects[i];
    Matte matte = {.text = object.name, .is_pattern = false, .index = object.index, .object = object.name};
    if (object.mattes.empty()) add(matte, fmt::format("objects[{}].name", i));
    for (std::size_t k = 0; k < object.mattes.size(); ++k) {
      matte.text = object.mattes[k];
      matte.is_pattern = matte.text.find('*') != std::string::npos;
      add(matte, fmt::format("objects[{}].mattes[{}]", i, k));
    }
  }
}

/// The same matte listed twice for one object is harmless.
void MatteNames::add(Matte matte, const std::string& where) {
  const auto check = [&](const auto& found, bool is_new, std::string_view what) {
    const std::size_t other = found->second;
    if (is_new || mattes_[other].index == matte.index) return;
    throw DataError(
        fault(where, fmt::format("\"{}\"", matte.text), "",
              fmt::format("a unique {}, but {} is \"{}\"", what, where_[other], mattes_[other].text)));
  };
  const auto [text, new_text] = by_text_.emplace(matte.text, mattes_.size());
  check(text, new_text, "name");
  if (!matte.is_pattern) {
    const auto [hash, new_hash] = by_hash_.emplace(cryptomatte_hash(matte.text), mattes_.size());
    check(hash, new_hash, "hash");
  }
  mattes_.push_back(std::move(matte));
  where_.push_back(where);
}

const MatteNames::Matte* MatteNames::find(std::string_view name) const {
  const auto itself = by_text_.find(std::string(name));
  if (itself != by_text_.end() && !mattes_[itself->second].is_pattern) return &mattes_[itself->second];
  const Matte* found = nullptr;
  for (const Matte& matte : mattes_) {
    if (!matte.is_pattern || !matches_matte(matte.text, name)) continue;
    if (found != nullptr && found->index != matte.index) {
      throw DataError(fmt::format("expected a name of one object, but {}'s \"{}\" and {}'s \"{}\" match it",
                                  found->object, found->text, matte.object, matte.text));
    }
    if (found == nullptr) found = &matte;
  }
  return found;
}

const MatteNames::Matte* MatteNames::find_hash(std::uint32_t hash) const noexcept {
  const auto found = by_hash_.find(hash);
  return found != by_hash_.end() ? &mattes_[found->second] : nullptr;
}

std::vector<std::string> MatteNames::texts() const {
  std::vector<std::string> texts;
  for (const Matte& matte : mattes_) texts.push_back(matte.text);
  return texts;
}

}  // namespace thermal
